#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "results/report/group.h"

namespace results::report {

/// A topic of programs, over all runs of a group.
struct TopicSums {
  std::string topic;  ///< Empty: not told of on the air.
  std::uint64_t samples = 0, delivered = 0, first_try = 0, repaired = 0;
  std::int64_t airtime_ns = 0;
  std::map<std::int64_t, std::uint64_t> latencies{};  ///< By lower edge of the bin [ns].
};
std::vector<TopicSums> topic_sums(const Group& group);

/// What the air was used for, over all runs of a group; most air time first.
std::vector<RunResult::AirKind> kind_sums(const Group& group);

/// Air time of all runs [ns].
std::int64_t airtime_of(const std::vector<RunResult::AirKind>& kinds);

/// The latency that this share of the samples does not exceed: the middle of the bin where it lies,
/// bins being at most 1/32 of their lower edge wide [s]. None: there are no samples.
/// @param share  0 .. 1
std::optional<double> latency_quantile(const std::map<std::int64_t, std::uint64_t>& latencies,
                                       double share);

/// What a kind of frame or submessage is drawn as: "user data", "user control" (heartbeats,
/// acknowledgements and the like of topics), else its purpose.
std::string use_of(const std::string& purpose, const std::string& kind);

}  // namespace results::report
