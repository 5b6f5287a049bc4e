#include <fmt/format.h>

#include "results/report/relay_sums.h"
#include "results/report/report_format.h"
#include "results/report/report_sections.h"
#include "results/report/text_table.h"

namespace results::report {

std::string relays_section(const Group& group) {
  const std::vector<RelaySums> sums = relay_sums(group);
  if (sums.empty()) return {};
  TextTable table({"access point", "to", "came", "passed on", "over the wire", "queue full",
                   "retry limit", "other", "waiting", "most at once", "mean wait ms"});
  for (const RelaySums& one : sums) {
    const std::uint64_t passed_on = one.count("delivered") + one.count("transmitted");
    const std::uint64_t told = passed_on + one.count("over the wire") + one.count("queue full") +
                               one.count("retry limit") + one.count("waiting");
    const double wait = static_cast<double>(one.waited_ns) * 1e-9;
    table.add_row({one.access_point, one.destination, std::to_string(one.came()),
                   std::to_string(passed_on), std::to_string(one.count("over the wire")),
                   std::to_string(one.count("queue full")),
                   std::to_string(one.count("retry limit")), std::to_string(one.came() - told),
                   std::to_string(one.count("waiting")), std::to_string(one.most),
                   one.queued == 0 ? "-" : milliseconds(wait / static_cast<double>(one.queued))});
  }
  return fmt::format("{}: frames forwarded by access points, total of {} runs\n{}", group.name,
                     group.runs.size(), table.text());
}

std::string sample_losses_section(const Group& group) {
  const SampleLossSums sums = sample_loss_sums(group);
  if (sums.empty()) return {};
  TextTable table({"topic", "verdict", "at", "samples"});
  for (const auto& [key, count] : sums) {
    const auto& [topic, verdict, at] = key;
    table.add_row({topic, verdict, at.empty() ? "-" : at, std::to_string(count)});
  }
  return fmt::format("{}: why samples of programs were not delivered, total of {} runs\n{}",
                     group.name, group.runs.size(), table.text());
}

}  // namespace results::report
