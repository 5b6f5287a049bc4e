#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/report/group.h"

namespace results::report {

/// A queue of an agent for one receiver and access category, over all runs of a group.
struct QueueSums {
  std::string agent, receiver;  ///< Names; of group frames "everyone".
  std::string category;         ///< "BK", "BE", "VI", "VO", or "all" without QoS.
  /// `most` and `most_bytes` are those of the run with most.
  RunResult::Queue all{};

  std::uint64_t dropped(const std::string& verdict) const;
  std::uint64_t dropped() const;  ///< Of all verdicts.
};
/// Sums by agent, receiver and category, in the order of the addresses.
std::vector<QueueSums> queue_sums(const Group& group);

}  // namespace results::report
