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
  std::optional<DueSample> recorded(const Recorded& recording) const;

  const WrittenTopic& topic_;
  hal::RandomStream instants_, sizes_;
  double phase_ = 0;         ///< Share of a period; of a recording, its shift in seconds.
  double elapsed_ = 0;       ///< s, of Poisson.
  std::uint64_t index_ = 0;  ///< Of the next sample.
  hal::Duration last_{};
};

}  // namespace programs::topics
