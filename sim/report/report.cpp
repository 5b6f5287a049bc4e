#include "sim/report/report.h"

#include "sim/report/report_sections.h"

namespace sim::report {

std::string report(const std::vector<std::filesystem::path>& folders,
                   const std::optional<Settings>& case_study) {
  std::vector<RunResult> runs;
  for (const std::filesystem::path& folder : find_results(folders)) {
    runs.push_back(read_run(folder));
  }
  const std::vector<Group> groups = group_runs(runs, case_study);
  std::string text = runs_section(runs) + "\n" + comparison_section(groups);
  if (groups.size() > 1) text += "\n" + differences_section(groups);
  for (const Group& group : groups) {
    if (group.runs.empty()) continue;
    text += "\n" + links_section(group) + "\n" + packets_section(group) + "\n" +
            losses_section(group) + "\n" + hops_section(group);
    if (const std::string routing = routing_section(group); !routing.empty()) {
      text += "\n" + routing;
    }
    if (const std::string air = air_section(group); !air.empty()) text += "\n" + air;
  }
  return text;
}

}  // namespace sim::report
