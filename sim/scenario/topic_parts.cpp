#include "sim/scenario/topic_parts.h"

#include <algorithm>
#include <set>

#include "hal/types/pattern.h"

namespace sim::scenario {
namespace {

const agents::AgentConfig* agent_of(const Scenario& scenario, hal::AgentId id) {
  const auto& all = scenario.simulation.agents;
  const auto found = std::ranges::find(all, id, &agents::AgentConfig::id);
  return found == all.end() ? nullptr : &*found;
}

bool is_reader(const TopicItem& item, const std::string& agent) {
  return std::ranges::any_of(
      item.readers, [&](const std::string& pattern) { return hal::matches(pattern, agent); });
}

}  // namespace

std::string topic_plan_file(const std::string& agent) { return agent + ".topics.plan.json"; }
std::string topic_journal_file(const std::string& agent) { return agent + ".topics.json"; }

std::vector<TopicPart> written_topics(const Scenario& scenario, const Group& group,
                                      hal::AgentId agent) {
  std::vector<TopicPart> parts;
  const agents::AgentConfig* const writer = agent_of(scenario, agent);
  if (writer == nullptr) return parts;
  for (const TopicItem& item : group.topics)
    parts.push_back({filled_in(item.name, {writer->name, {}, {}, {}}), &item});
  return parts;
}

std::vector<TopicPart> read_topics(const Scenario& scenario, hal::AgentId agent) {
  std::vector<TopicPart> parts;
  const agents::AgentConfig* const reader = agent_of(scenario, agent);
  if (reader == nullptr || !reader->network) return parts;
  std::set<std::string> names;
  for (const Group& group : scenario.groups) {
    for (const hal::AgentId writer : group.agents) {
      if (writer == agent) continue;
      for (TopicPart& part : written_topics(scenario, group, writer)) {
        if (is_reader(*part.item, reader->name) && names.insert(part.name).second)
          parts.push_back(std::move(part));
      }
    }
  }
  return parts;
}

bool has_topics(const Scenario& scenario, const Group& group, hal::AgentId agent) {
  return !group.topics.empty() || !read_topics(scenario, agent).empty();
}

}  // namespace sim::scenario
