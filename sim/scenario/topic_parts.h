#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "hal/files/recording/recording.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// Files in the results folder of an agent that has topics: what its player is to do, and what it
/// did.
std::string topic_plan_file(const std::string& agent);
std::string topic_journal_file(const std::string& agent);

/// The recordings of a run, each read once.
class Recordings {
 public:
  using Recording = hal::files::recording::Recording;
  /// @throws std::runtime_error  as hal::files::recording::read_recording().
  const Recording& of(const std::filesystem::path& file);

 private:
  std::map<std::filesystem::path, Recording> read_;
};

/// A topic as one agent writes or reads it.
struct TopicPart {
  std::string name;  ///< On DDS.
  hal::TopicQos qos;
  const TopicItem* item = nullptr;
  const hal::files::recording::RecordedTopic* recorded = nullptr;  ///< Null: it is not.
};

/// Which of its agent's participants writes or reads a topic: parts with equal names have one in
/// common; "" is that of all topics that are not shared out.
std::string writing_participant(const TopicPart& part);
std::string reading_participant(const TopicPart& part);

/// Topics that an agent of the group writes, in order of declaration. Recorded topics get the
/// agent's namespace, "rt/scan" becomes "rt/r0/scan", unless they are renamed.
std::vector<TopicPart> written_topics(const Scenario& scenario, const Group& group,
                                      hal::AgentId agent, Recordings& recordings);

/// Topics that the agent reads, each once, in order of declaration: those of other agents that have
/// it among their readers. An agent without a network reads nothing.
std::vector<TopicPart> read_topics(const Scenario& scenario, hal::AgentId agent,
                                   Recordings& recordings);

/// Whether an agent is among the readers of another one's item.
bool is_reader(const TopicItem& item, const std::string& agent);

/// Whether an agent of the group writes or reads any topic.
bool has_topics(const Scenario& scenario, const Group& group, hal::AgentId agent);

/// What is wrong with the recordings of a scenario, "file:line:column: topics: …": they cannot be
/// read, have no topic that is meant, or give an agent a topic twice.
std::vector<std::string> recording_mistakes(const Scenario& scenario);

}  // namespace sim::scenario
