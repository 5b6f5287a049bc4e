#include "sim/scenario/topic_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "hal/types/pattern.h"

namespace sim::scenario {
namespace {

using hal::files::recording::RecordedTopic;
using hal::files::recording::Recording;

const agents::AgentConfig* agent_of(const Scenario& scenario, hal::AgentId id) {
  const auto& all = scenario.simulation.agents;
  const auto found = std::ranges::find(all, id, &agents::AgentConfig::id);
  return found == all.end() ? nullptr : &*found;
}

/// Name of a recorded topic for the agent that kAgentWord stands for.
std::string renamed(const TopicItem& item, const std::string& name) {
  const auto given = item.recorded.rename.find(name);
  if (given != item.recorded.rename.end()) return given->second;
  constexpr std::string_view kRos = "rt/";  // of the topics of ROS 2
  const std::size_t begin = name.starts_with(kRos) ? kRos.size() : 0;
  return fmt::format("{}{}/{}", name.substr(0, begin), kAgentWord, name.substr(begin));
}

/// QoS of a recorded topic: as stated, else as recorded, else the defaults.
hal::TopicQos recorded_qos(const RecordedTraffic& stated, const RecordedTopic& topic) {
  hal::TopicQos qos = topic.qos.value_or(hal::TopicQos{});
  qos.reliability = stated.reliability.value_or(qos.reliability);
  qos.durability = stated.durability.value_or(qos.durability);
  qos.depth = stated.depth.value_or(qos.depth);
  if (stated.deadline) qos.deadline = stated.deadline;
  return qos;
}

void add_parts(std::vector<TopicPart>& parts, const TopicItem& item, const std::string& writer,
               Recordings& recordings) {
  const ProgramWords words{writer, {}, {}, {}};
  if (!item.is_recorded()) {
    parts.push_back({filled_in(item.name, words), item.qos, &item, nullptr});
    return;
  }
  for (const RecordedTopic& topic : recordings.of(item.recorded.from).topics) {
    if (!hal::matches(item.name, topic.name)) continue;
    parts.push_back({filled_in(renamed(item, topic.name), words),
                     recorded_qos(item.recorded, topic), &item, &topic});
  }
}

/// @return what is wrong with the recording of an item; empty: nothing.
std::string complaint(const TopicItem& item, Recordings& recordings) {
  const Recording& recording = recordings.of(item.recorded.from);
  const std::string file = item.recorded.from.filename().string();
  const auto is_meant = [&](const RecordedTopic& one) { return hal::matches(item.name, one.name); };
  const bool has_flows = item.recorded.has_flows && !recording.flows.empty();
  if (std::ranges::none_of(recording.topics, is_meant) && !has_flows)
    return fmt::format("from: {} has no topic like '{}'", file, item.name);
  for (const auto& [name, to] : item.recorded.rename) {
    if (std::ranges::count(recording.topics, name, &RecordedTopic::name) == 0)
      return fmt::format("rename: {} has no topic '{}'", file, name);
  }
  return {};
}

std::string participant_of(const TopicPart& part, std::optional<std::uint32_t> recorded) {
  switch (part.item->participants) {
    case Participants::kTopic:
      return "topic " + part.name;
    case Participants::kRecorded:
      if (recorded) return fmt::format("{} of {}", *recorded, part.item->recorded.from.string());
      return {};
    case Participants::kAgent:
      break;
  }
  return {};
}

/// Name of a topic that there is twice; empty: none.
std::string twice(const std::vector<TopicPart>& parts) {
  std::set<std::string> names;
  for (const TopicPart& part : parts) {
    if (!names.insert(part.name).second) return part.name;
  }
  return {};
}

void add_mistakes(std::vector<std::string>& mistakes, const Scenario& scenario, const Group& group,
                  Recordings& recordings) {
  const std::size_t before = mistakes.size();
  for (const TopicItem& item : group.topics) {
    if (!item.is_recorded()) continue;
    try {
      const std::string what = complaint(item, recordings);
      if (!what.empty()) mistakes.push_back(fmt::format("{}: topics.{}", item.place, what));
    } catch (const std::runtime_error& e) {
      // The file is where the item names it: without its folder.
      std::string what = e.what();
      const std::string folder = item.recorded.from.parent_path().string() + "/";
      if (what.starts_with(folder)) what.erase(0, folder.size());
      mistakes.push_back(fmt::format("{}: topics.from: {}", item.place, what));
    }
  }
  if (mistakes.size() > before || group.topics.empty()) return;
  const std::string name = twice(written_topics(scenario, group, group.agents.front(), recordings));
  if (name.empty()) return;
  mistakes.push_back(fmt::format("{}: topics: {} writes '{}' twice", group.topics.back().place,
                                 agent_of(scenario, group.agents.front())->name, name));
}

}  // namespace

std::string writing_participant(const TopicPart& part) {
  return participant_of(part, part.recorded != nullptr ? part.recorded->writer : std::nullopt);
}

std::string reading_participant(const TopicPart& part) {
  return participant_of(part, part.recorded != nullptr ? part.recorded->reader : std::nullopt);
}

const Recording& Recordings::of(const std::filesystem::path& file) {
  const auto found = read_.find(file);
  if (found != read_.end()) return found->second;
  return read_.emplace(file, hal::files::recording::read_recording(file)).first->second;
}

std::string topic_plan_file(const std::string& agent) { return agent + ".topics.plan.json"; }
std::string topic_journal_file(const std::string& agent) { return agent + ".topics.json"; }

bool is_reader(const TopicItem& item, const std::string& agent) {
  return std::ranges::any_of(
      item.readers, [&](const std::string& pattern) { return hal::matches(pattern, agent); });
}

std::vector<TopicPart> written_topics(const Scenario& scenario, const Group& group,
                                      hal::AgentId agent, Recordings& recordings) {
  std::vector<TopicPart> parts;
  const agents::AgentConfig* const writer = agent_of(scenario, agent);
  if (writer == nullptr) return parts;
  for (const TopicItem& item : group.topics) add_parts(parts, item, writer->name, recordings);
  return parts;
}

std::vector<TopicPart> read_topics(const Scenario& scenario, hal::AgentId agent,
                                   Recordings& recordings) {
  std::vector<TopicPart> parts;
  const agents::AgentConfig* const reader = agent_of(scenario, agent);
  if (reader == nullptr || !reader->network) return parts;
  std::set<std::string> names;
  const auto take = [&](std::vector<TopicPart> written) {
    for (TopicPart& part : written) {
      if (is_reader(*part.item, reader->name) && names.insert(part.name).second)
        parts.push_back(std::move(part));
    }
  };
  for (const Group& group : scenario.groups) {
    for (const hal::AgentId writer : group.agents)
      if (writer != agent) take(written_topics(scenario, group, writer, recordings));
  }
  return parts;
}

bool has_topics(const Scenario& scenario, const Group& group, hal::AgentId agent) {
  if (!group.topics.empty()) return true;
  const agents::AgentConfig* const reader = agent_of(scenario, agent);
  if (reader == nullptr || !reader->network) return false;
  return std::ranges::any_of(scenario.groups, [&](const Group& other) {
    return std::ranges::any_of(
        other.topics, [&](const TopicItem& item) { return is_reader(item, reader->name); });
  });
}

std::vector<std::string> recording_mistakes(const Scenario& scenario) {
  std::vector<std::string> mistakes;
  Recordings recordings;
  for (const Group& group : scenario.groups) add_mistakes(mistakes, scenario, group, recordings);
  return mistakes;
}

}  // namespace sim::scenario
