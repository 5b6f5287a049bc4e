#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "results/report/group.h"

namespace results::report {

/// Sums for a DDS topic of programs over all runs of a group.
struct TopicSums {
  std::string topic;  ///< Empty: SEDP did not announce it on the air.
  std::uint64_t samples = 0, delivered = 0, first_try = 0, repaired = 0;
  std::int64_t airtime_ns = 0;
  /// Samples per latency bin, by the bin's lower edge [ns].
  std::map<std::int64_t, std::uint64_t> latencies{};
};
std::vector<TopicSums> topic_sums(const Group& group);

/// Use of the air by kind over all runs of a group, longest air time first.
std::vector<RunResult::AirKind> kind_sums(const Group& group);

/// Total air time [ns].
std::int64_t airtime_of(const std::vector<RunResult::AirKind>& kinds);

/// The latency that this share of the samples does not exceed [s], given as the middle of its bin;
/// a bin is at most 1/32 of its lower edge wide. None: there are no samples.
/// @param share  0 .. 1
std::optional<double> latency_quantile(const std::map<std::int64_t, std::uint64_t>& latencies,
                                       double share);

/// The group under which a kind of frame or submessage is drawn: "user data", "user control"
/// (heartbeats, acknowledgements and the like of topics), otherwise its purpose.
std::string use_of(const std::string& purpose, const std::string& kind);

}  // namespace results::report
