#include "programs/topics/schedule.h"

#include <algorithm>

#include "hal/types/math.h"
#include "hal/types/overloaded.h"

namespace programs::topics {
namespace {

/// The stream of an agent's topic. A recording's topics keep their places in time to each other, so
/// that they have their shift in common.
std::string stream_of(const Plan& plan, const WrittenTopic& topic, const char* purpose) {
  const bool is_recorded = std::holds_alternative<Recorded>(topic.rhythm);
  return plan.name + "/topics/" + (is_recorded ? "" : topic.name) + "/" + purpose;
}

}  // namespace

Schedule::Schedule(const Plan& plan, const WrittenTopic& topic)
    : topic_(topic),
      instants_(plan.seed, stream_of(plan, topic, "instants")),
      sizes_(plan.seed, stream_of(plan, topic, "sizes")),
      phase_(instants_.uniform()) {}

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

std::optional<DueSample> Schedule::recorded(const Recorded& recording) const {
  const std::size_t count = recording.samples.size();
  if (count == 0 || (index_ >= count && recording.repeat_after <= hal::Duration::zero()))
    return std::nullopt;
  const Recorded::Sample& sample = recording.samples[index_ % count];
  const auto round = static_cast<std::int64_t>(index_ / count);
  return DueSample{hal::from_seconds(phase_) + round * recording.repeat_after + sample.at,
                   std::max(sample.bytes, kLeastSize)};
}

std::optional<DueSample> Schedule::next() {
  DueSample due;
  if (const auto* const recording = std::get_if<Recorded>(&topic_.rhythm)) {
    const auto sample = recorded(*recording);
    if (!sample) return std::nullopt;
    due = *sample;
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
