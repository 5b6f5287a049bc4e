#pragma once

#include <string>
#include <vector>

#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// Files in the results folder of an agent that has topics: what its player is to do, and what it
/// did.
std::string topic_plan_file(const std::string& agent);
std::string topic_journal_file(const std::string& agent);

/// A topic as one agent writes or reads it.
struct TopicPart {
  std::string name;  ///< On DDS.
  const TopicItem* item = nullptr;
};

/// Topics that an agent of the group writes, in order of declaration.
std::vector<TopicPart> written_topics(const Scenario& scenario, const Group& group,
                                      hal::AgentId agent);

/// Topics that the agent reads, each once, in order of declaration: those of other agents that have
/// it among their readers. An agent without a network reads nothing.
std::vector<TopicPart> read_topics(const Scenario& scenario, hal::AgentId agent);

/// Whether an agent of the group writes or reads any topic.
bool has_topics(const Scenario& scenario, const Group& group, hal::AgentId agent);

}  // namespace sim::scenario
