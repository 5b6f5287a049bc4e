#include "baraka/fleet/fleet_needs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "hal/types/pattern.h"
#include "results/fleet/fleet_run.h"
#include "sim/scenario/scenario.h"
#include "sim/scenario/topic_parts.h"

namespace baraka::fleet {
namespace {

using results::fleet::Case;
using results::fleet::FleetFile;
using results::fleet::FleetPlan;
using results::fleet::Need;
using sim::scenario::Group;
using sim::scenario::Scenario;

/// Topics with their readers.
using Pairs = std::set<std::pair<std::string, std::string>>;

bool has_other_traffic(const Scenario& scenario) {
  return std::ranges::any_of(
      scenario.groups, [](const Group& group) { return !group.programs.empty() || group.inside; });
}

Pairs pairs_of(const Scenario& scenario) {
  Pairs pairs;
  sim::scenario::Recordings recordings;
  for (const sim::agents::AgentConfig& agent : scenario.simulation.agents) {
    for (const auto& part : read_topics(scenario, agent.id, recordings))
      pairs.emplace(part.name, agent.name);
  }
  return pairs;
}

/// "rt/*/odom, rt/*/scan to base; rt/tf to r0, …", with a * for the agents' names in topics.
std::string listed(const Pairs& pairs, const Scenario& scenario) {
  std::vector<std::string> agents;
  for (const auto& agent : scenario.simulation.agents) agents.push_back(agent.name);
  std::map<std::string, std::set<std::string>> by_reader;
  for (const auto& [topic, reader] : pairs)
    by_reader[reader].insert(results::fleet::group_of(topic, agents));
  std::map<std::set<std::string>, std::vector<std::string>> readers;
  for (const auto& [reader, topics] : by_reader) readers[topics].push_back(reader);
  std::string list;
  for (const auto& [topics, some] : readers) {
    list += fmt::format("{}{} to {}{}", list.empty() ? "" : "; ", fmt::join(topics, ", "),
                        some.front(), some.size() > 1 ? ", …" : "");
  }
  return list.empty() ? "none" : list;
}

Scenario scenario_of(const FleetPlan& plan, std::size_t point, const std::filesystem::path& file) {
  std::vector<std::string> overrides;
  for (const auto& value : plan.campaign.points[point])
    overrides.push_back(value.key + "=" + value.yaml);
  return sim::scenario::load_scenario(file, overrides);
}

}  // namespace

std::vector<std::string> unmatched_needs(const FleetFile& fleet, const FleetPlan& plan,
                                         const std::filesystem::path& scenario) {
  std::vector<std::string> mistakes;
  std::set<std::string> told;
  for (std::size_t i = 0; i < plan.cases.size(); ++i) {
    if (plan.cases[i].robots != fleet.robots.back()) continue;
    const Scenario one = scenario_of(plan, i, scenario);
    if (has_other_traffic(one)) continue;
    const Pairs pairs = pairs_of(one);
    for (const Need& need : fleet.needs) {
      const auto is_meant = [&](const auto& pair) {
        return hal::matches(need.topic, pair.first) && hal::matches(need.readers, pair.second);
      };
      if (std::ranges::any_of(pairs, is_meant) || !told.insert(need.place).second) continue;
      mistakes.push_back(fmt::format(
          "{}: need: no topic like '{}' with a reader like '{}' ({}); "
          "there are {}",
          need.place, need.topic, need.readers, plan.campaign.labels[i], listed(pairs, one)));
    }
  }
  return mistakes;
}

}  // namespace baraka::fleet
