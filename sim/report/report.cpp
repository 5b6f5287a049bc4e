#include "sim/report/report.h"

#include <utility>

#include "sim/campaign/campaign_reader.h"
#include "sim/report/experiment_section.h"
#include "sim/report/report_sections.h"

namespace sim::report {
namespace {

std::string runs_text(const std::vector<RunResult>& runs,
                      const std::optional<Settings>& case_study) {
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
    for (const std::string& part :
         {air_section(group), sample_losses_section(group), relays_section(group)}) {
      if (!part.empty()) text += "\n" + part;
    }
  }
  return text + "\n";
}

}  // namespace

Sources read_sources(const std::vector<std::filesystem::path>& folders) {
  Sources sources;
  std::vector<std::filesystem::path> plain;
  std::vector<Experiment> campaigns;
  for (const std::filesystem::path& folder : folders) {
    if (campaign::CampaignReader::is_campaign(folder)) {
      campaigns.push_back(experiment_of_campaign(folder));
    } else {
      plain.push_back(folder);
    }
  }
  const std::vector<std::filesystem::path> results = find_results(plain);
  for (const std::filesystem::path& folder : results) sources.runs.push_back(read_run(folder));
  if (!results.empty()) sources.experiments.push_back(experiment_of(results));
  for (Experiment& one : campaigns) sources.experiments.push_back(std::move(one));
  return sources;
}

std::string report(const Sources& sources, const std::optional<Settings>& case_study) {
  std::string text;
  if (!sources.runs.empty()) text += runs_text(sources.runs, case_study);
  for (const Experiment& experiment : sources.experiments) {
    text += (text.empty() || text.ends_with("\n\n") ? "" : "\n") + experiment_section(experiment);
  }
  return text;
}

}  // namespace sim::report
