#include "programs/topics/schedule.h"

#include <algorithm>

#include "hal/types/math.h"
#include "hal/types/overloaded.h"

namespace programs::topics {
namespace {

std::string stream_of(const Plan& plan, const WrittenTopic& topic, const char* purpose) {
  return plan.name + "/topics/" + topic.name + "/" + purpose;
}

/// Of the recording of a topic: its agent's, and that of the participant which writes it.
hal::Duration shift_of(const Plan& plan, const WrittenTopic& topic) {
  const auto* const recording = std::get_if<Recorded>(&topic.rhythm);
  if (recording == nullptr) return {};
  if (topic.participant == 0) return recording_shift(plan);  // flows and topics without another
  const std::string stream = plan.name + "/topics/participant/" + std::to_string(topic.participant);
  const double share = hal::RandomStream(plan.seed, stream).uniform();
  return recording_shift(plan) + hal::from_seconds(share * hal::to_seconds(recording->spread));
}

}  // namespace

hal::Duration recording_shift(const Plan& plan) {
  return hal::from_seconds(hal::RandomStream(plan.seed, plan.name + "/topics/recording").uniform());
}

hal::Duration participant_shift(const Plan& part) {
  const auto is_recorded = [](const WrittenTopic& topic) {
    return topic.participant > 0 && std::holds_alternative<Recorded>(topic.rhythm);
  };
  if (part.writes.empty() || !std::ranges::all_of(part.writes, is_recorded)) return {};
  return shift_of(part, part.writes.front());
}

std::optional<DueSample> sample_of(const Recorded& recording, std::uint64_t index) {
  const std::size_t count = recording.samples.size();
  if (count == 0 || (index >= count && recording.repeat_after <= hal::Duration::zero()))
    return std::nullopt;
  const Recorded::Sample& sample = recording.samples[index % count];
  const auto round = static_cast<std::int64_t>(index / count);
  return DueSample{round * recording.repeat_after + sample.at, sample.bytes};
}

Schedule::Schedule(const Plan& plan, const WrittenTopic& topic)
    : topic_(topic),
      instants_(plan.seed, stream_of(plan, topic, "instants")),
      sizes_(plan.seed, stream_of(plan, topic, "sizes")),
      phase_(instants_.uniform()),
      shift_(shift_of(plan, topic)) {}

hal::Duration Schedule::at(const Periodic& rhythm) {
  const double period = 1 / rhythm.rate;
  const double jitter = (2 * instants_.uniform() - 1) * hal::to_seconds(rhythm.jitter);
  return hal::from_seconds((phase_ + static_cast<double>(index_)) * period + jitter);
}

hal::Duration Schedule::at(const Poisson& rhythm) {
  // Inversion of the distribution function; 1 - u is from (0, 1].
  elapsed_ -= hal::math::log(1 - instants_.uniform()) / rhythm.rate;
  return hal::from_seconds(elapsed_);
}

hal::Duration Schedule::at(const Bursts& rhythm) {
  const std::uint64_t burst = index_ / rhythm.samples;
  const auto within = static_cast<std::int64_t>(index_ % rhythm.samples);
  return hal::from_seconds((phase_ + static_cast<double>(burst)) / rhythm.rate) +
         within * rhythm.spacing;
}

std::uint32_t Schedule::size() {
  return std::visit(
      hal::Overloaded{
          [this](const SizeCycle& c) { return c.sizes[index_ % c.sizes.size()]; },
          [this](const UniformSizes& c) { return c.from + sizes_.below(c.to - c.from + 1); }},
      topic_.sizes);
}

std::optional<DueSample> Schedule::next() {
  DueSample due;
  if (const auto* const recording = std::get_if<Recorded>(&topic_.rhythm)) {
    const auto sample = sample_of(*recording, index_);
    if (!sample) return std::nullopt;
    due = {shift_ + sample->at, std::max(sample->bytes, kLeastSize)};
  } else {
    due.at = std::visit(hal::Overloaded{[](const Recorded&) { return hal::Duration{}; },
                                        [this](const auto& rhythm) { return at(rhythm); }},
                        topic_.rhythm);
    due.bytes = size();
  }
  ++index_;
  last_ = due.at = std::max(due.at, last_);
  return due;
}

}  // namespace programs::topics
