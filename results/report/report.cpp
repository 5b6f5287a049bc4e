#include "results/report/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "results/campaign/campaign_reader.h"
#include "results/report/experiment_section.h"
#include "results/report/report_sections.h"

namespace results::report {
namespace {

bool has_motes(const Group& group) {
  return std::ranges::any_of(group.runs.front()->agents,
                             [](const RunResult::Agent& agent) { return !agent.is_robot; });
}

bool any_run(const Group& group, bool (*has)(const RunResult&)) {
  return std::ranges::any_of(group.runs, [has](const RunResult* run) { return has(*run); });
}

bool has_frames(const RunResult& run) {
  return !run.packets.empty() ||
         std::ranges::any_of(run.frame_verdicts,
                             [](const RunResult::FrameVerdict& one) { return one.count > 0; });
}

/// Whether the routing protocol of any agent did something.
bool has_routed(const RunResult& run) {
  return std::ranges::any_of(run.routing_events, [](const auto& one) { return one.second > 0; });
}

std::string head_text(const std::vector<RunResult>& runs) {
  std::vector<std::string> names;
  for (const RunResult& run : runs) {
    const std::string name = run.value("scenario");
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return fmt::format("Scenario{}: {}\n\n", names.size() == 1 ? "" : "s", fmt::join(names, ", "));
}

/// The sections about messages and the radio for which a group has data; all of them for the
/// paper's case study.
std::vector<std::string> network_sections(const Group& group) {
  const bool all = group.is_the_papers();
  std::vector<std::string> parts;
  if (all || has_motes(group)) parts.push_back(links_section(group));
  const bool has_sent = any_run(group, has_frames);
  if (all || (has_sent && has_motes(group))) parts.push_back(packets_section(group));
  if (all || has_sent) parts.push_back(losses_section(group));
  const auto has_hops = [](const RunResult& run) { return !run.hops.empty(); };
  if (all || any_run(group, has_hops)) parts.push_back(hops_section(group));
  if (all || any_run(group, has_routed)) parts.push_back(routing_section(group));
  if (!all && !has_sent) parts.push_back(group.name + ": no frame was sent by radio\n");
  for (const auto& section : {air_section, sample_losses_section, relays_section, queues_section}) {
    parts.push_back(section(group));
  }
  std::erase(parts, "");
  return parts;
}

/// Whether an experiment consists of one run that the other tables describe completely.
bool says_nothing_new(const Experiment& experiment, const Sources& sources) {
  return sources.runs.size() == 1 && experiment.runs.size() == 1 && experiment.left_out.empty() &&
         experiment.scenario.empty() && experiment.requests.empty();
}

std::string runs_text(const std::vector<RunResult>& runs,
                      const std::optional<Settings>& case_study) {
  const std::vector<Group> groups = group_runs(runs, case_study);
  std::string text = head_text(runs) + runs_section(runs);
  // The user's own observables come first, but in the case study the comparison with the paper.
  std::vector<std::string> parts;
  parts.reserve(groups.size() + 1);
  for (const Group& group : groups) parts.push_back(recorded_section(group));
  std::erase(parts, "");
  parts.insert(has_the_papers(groups) ? parts.begin() : parts.end(), comparison_section(groups));
  for (const std::string& part : parts) text += "\n" + part;
  if (groups.size() > 1) text += "\n" + differences_section(groups);
  for (const Group& group : groups) {
    if (group.runs.empty()) continue;
    for (const std::string& part : network_sections(group)) text += "\n" + part;
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
    if (says_nothing_new(experiment, sources)) continue;
    text += (text.empty() || text.ends_with("\n\n") ? "" : "\n") + experiment_section(experiment);
  }
  return text;
}

}  // namespace results::report
