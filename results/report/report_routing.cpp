#include <map>
#include <string>

#include "results/report/report_sections.h"
#include "results/report/text_table.h"

namespace results::report {

std::string routing_section(const Group& group) {
  std::map<std::string, std::uint64_t> sums;
  for (const RunResult* run : group.runs) {
    for (const auto& [event, count] : run->routing_events) sums[event] += count;
  }
  if (sums.empty()) return "";
  TextTable table({"event", "count"});
  for (const auto& [event, count] : sums) table.add_row({event, std::to_string(count)});
  return group.name + ": routing events, all agents and runs\n" + table.text();
}

}  // namespace results::report
