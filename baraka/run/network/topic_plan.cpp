#include "baraka/run/network/topic_plan.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

#include "hal/types/overloaded.h"

namespace baraka::run::network {
namespace {

using programs::topics::WrittenTopic;
using sim::scenario::TopicItem;

decltype(WrittenTopic::sizes) sizes_of(const TopicItem& item) {
  using Sizes = decltype(WrittenTopic::sizes);
  return std::visit(hal::Overloaded{[](const std::vector<std::uint32_t>& c) -> Sizes {
                                      return programs::topics::SizeCycle{c};
                                    },
                                    [](const sim::scenario::SizeRange& c) -> Sizes {
                                      return programs::topics::UniformSizes{c.from, c.to};
                                    }},
                    item.sizes);
}

decltype(WrittenTopic::rhythm) rhythm_of(const TopicItem& item) {
  using Rhythm = decltype(WrittenTopic::rhythm);
  return std::visit(hal::Overloaded{[](const sim::scenario::PeriodicSamples& c) -> Rhythm {
                                      return programs::topics::Periodic{c.rate, c.jitter};
                                    },
                                    [](const sim::scenario::PoissonSamples& c) -> Rhythm {
                                      return programs::topics::Poisson{c.rate};
                                    },
                                    [](const sim::scenario::SampleBursts& c) -> Rhythm {
                                      return programs::topics::Bursts{c.rate, c.samples, c.spacing};
                                    }},
                    item.rhythm);
}

programs::topics::Recorded played(const std::vector<hal::files::recording::RecordedSample>& samples,
                                  const TopicItem& item,
                                  const hal::files::recording::Recording& recording) {
  programs::topics::Recorded recorded;
  for (const auto& sample : samples) recorded.samples.push_back({sample.at, sample.bytes});
  if (item.recorded.repeats) recorded.repeat_after = recording.length;
  recorded.spread = item.recorded.spread;
  return recorded;
}

/// Numbers of an agent's participants: "" is 0, the others follow as they are asked for.
class ParticipantNumbers {
 public:
  std::uint32_t of(const std::string& name) {
    const auto next = static_cast<std::uint32_t>(numbers_.size());
    return numbers_.try_emplace(name, next).first->second;
  }

 private:
  std::map<std::string, std::uint32_t> numbers_{{"", 0}};
};

WrittenTopic written(const sim::scenario::TopicPart& part, sim::scenario::Recordings& recordings) {
  if (part.recorded == nullptr)
    return {part.name, part.qos, sizes_of(*part.item), rhythm_of(*part.item)};
  const auto& recording = recordings.of(part.item->recorded.from);
  return {part.name, part.qos, {}, played(part.recorded->samples, *part.item, recording)};
}

/// Addresses of the agents that read an item of the writer's.
std::vector<std::string> addresses(const sim::scenario::Scenario& scenario, const TopicItem& item,
                                   hal::AgentId writer) {
  std::vector<std::string> found;
  for (const sim::agents::AgentConfig& agent : scenario.simulation.agents) {
    if (agent.network && agent.id != writer && is_reader(item, agent.name))
      found.push_back(sim::scenario::dotted(agent.network->address));
  }
  return found;
}

/// Flows of the recordings that the agent's group plays.
std::vector<programs::topics::SentFlow> sent_flows(const sim::scenario::PlannedProgram& planned,
                                                   const sim::scenario::Scenario& scenario,
                                                   sim::scenario::Recordings& recordings) {
  std::vector<programs::topics::SentFlow> flows;
  for (const TopicItem& item : planned.group->topics) {
    if (!item.recorded.has_flows) continue;
    const auto& recording = recordings.of(item.recorded.from);
    const std::vector<std::string> to = addresses(scenario, item, planned.agent);
    for (const auto& flow : recording.flows)
      flows.push_back({flow.port, to, played(flow.datagrams, item, recording)});
  }
  return flows;
}

/// Ports of the flows that others send to the agent.
std::set<std::uint16_t> received_ports(const sim::scenario::PlannedProgram& planned,
                                       const sim::scenario::Scenario& scenario,
                                       sim::scenario::Recordings& recordings) {
  std::set<std::uint16_t> ports;
  const auto add = [&](const TopicItem& item) {
    if (!item.recorded.has_flows || !is_reader(item, planned.agent_name)) return;
    for (const auto& flow : recordings.of(item.recorded.from).flows) ports.insert(flow.port);
  };
  for (const sim::scenario::Group& group : scenario.groups) {
    const bool has_others = &group != planned.group || group.agents.size() > 1;
    if (has_others) std::ranges::for_each(group.topics, add);
  }
  return ports;
}

}  // namespace

programs::topics::Plan topic_plan(const sim::scenario::PlannedProgram& planned,
                                  const sim::scenario::Scenario& scenario,
                                  const std::filesystem::path& results,
                                  sim::scenario::Recordings& recordings) {
  const sim::scenario::DdsKeys& dds = planned.group->dds;
  programs::topics::Plan plan{
      .name = planned.agent_name,
      .domain = dds.domain,
      .seed = scenario.simulation.seed,
      .begin = dds.begin,
      .journal = results / sim::scenario::topic_journal_file(planned.agent_name),
      .writes = {},
      .reads = {}};
  ParticipantNumbers numbers;
  for (const auto& part : written_topics(scenario, *planned.group, planned.agent, recordings)) {
    plan.writes.push_back(written(part, recordings));
    plan.writes.back().participant = numbers.of(writing_participant(part));
  }
  for (const auto& part : read_topics(scenario, planned.agent, recordings))
    plan.reads.push_back({part.name, part.qos, numbers.of(reading_participant(part))});
  plan.flows = sent_flows(planned, scenario, recordings);
  const std::set<std::uint16_t> ports = received_ports(planned, scenario, recordings);
  plan.ports.assign(ports.begin(), ports.end());
  return plan;
}

void write_topic_plan(const sim::scenario::PlannedProgram& planned,
                      const sim::scenario::Scenario& scenario, const std::filesystem::path& results,
                      sim::scenario::Recordings& recordings) {
  const std::filesystem::path file =
      filled_in(planned.program->command.back(), words_of(planned, scenario, results));
  std::ofstream out(file);
  out << json_text(topic_plan(planned, scenario, std::filesystem::absolute(results), recordings))
      << std::flush;
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace baraka::run::network
