#include "baraka/run/network/topic_plan.h"

#include <fstream>
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

WrittenTopic written(const sim::scenario::TopicPart& part, sim::scenario::Recordings& recordings) {
  if (part.recorded == nullptr)
    return {part.name, part.qos, sizes_of(*part.item), rhythm_of(*part.item)};
  programs::topics::Recorded recorded;
  for (const auto& sample : part.recorded->samples)
    recorded.samples.push_back({sample.at, sample.bytes});
  if (part.item->recorded.repeats)
    recorded.repeat_after = recordings.of(part.item->recorded.from).length;
  return {part.name, part.qos, {}, std::move(recorded)};
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
  for (const auto& part : written_topics(scenario, *planned.group, planned.agent, recordings))
    plan.writes.push_back(written(part, recordings));
  for (const auto& part : read_topics(scenario, planned.agent, recordings))
    plan.reads.push_back({part.name, part.qos});
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
