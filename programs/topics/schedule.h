#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "hal/types/random.h"
#include "programs/topics/plan.h"

namespace programs::topics {

/// A sample to be written.
struct DueSample {
  hal::Duration at{};       ///< Since the begin of publication.
  std::uint32_t bytes = 0;  ///< Serialised.
};

/// By how much an agent's recordings begin later, from [0 s, 1 s): drawn once for all of its topics
/// and flows. Those of one participant keep their places in time to each other.
hal::Duration recording_shift(const Plan& plan);

/// By how much later than its process the participant of a part_of() a plan is made: as much as its
/// recordings begin later, if it writes nothing else; 0 of the agent's common participant, 0.
/// Robots are not switched on together.
hal::Duration participant_shift(const Plan& part);

/// Sample `index`, from 0 on, of a recording that is played from time 0 on; none: it is over.
std::optional<DueSample> sample_of(const Recorded& recording, std::uint64_t index);

/// When a topic's samples are due, and their sizes. It depends only on the plan's seed and name and
/// on the topic: draws of one topic do not change those of another.
class Schedule {
 public:
  /// @param topic  must outlive this object.
  Schedule(const Plan& plan, const WrittenTopic& topic);

  /// The next sample, none: the recording is over. Times never decrease.
  std::optional<DueSample> next();

 private:
  hal::Duration at(const Periodic& rhythm);
  hal::Duration at(const Poisson& rhythm);
  hal::Duration at(const Bursts& rhythm);
  std::uint32_t size();

  const WrittenTopic& topic_;
  hal::RandomStream instants_, sizes_;
  double phase_ = 0;         ///< Share of a period.
  hal::Duration shift_{};    ///< Of a recording: the agent's and the participant's.
  double elapsed_ = 0;       ///< s, of Poisson.
  std::uint64_t index_ = 0;  ///< Of the next sample.
  hal::Duration last_{};
};

}  // namespace programs::topics
