#pragma once

#include <optional>
#include <string>

#include "hal/types/topic_qos.h"

namespace hal::files::recording {

/// QoS that a writer of a recorded topic offered.
struct OfferedQos {
  TopicQos qos;
  bool tells_depth = true;  ///< False: qos.depth is the default.
};

/// Reads `offered_qos_profiles` as rosbag2 records it with a topic: a list of profiles in YAML, one
/// for each publisher, whose policies are the numbers of `rmw_qos_*_policy_t` (up to Humble) or
/// their words (from Iron on). A policy that the list does not tell, or whose value is
/// system_default, unknown or best_available, has the default of TopicQos. The first publisher's
/// counts, but reliable and transient local win. A deadline of 0 s or of RMW_DURATION_INFINITE is
/// none.
/// @return nullopt: the text is empty or has no profile.
/// @throws std::runtime_error  it is not such a list, without the place.
std::optional<OfferedQos> read_offered_qos(const std::string& text);

}  // namespace hal::files::recording
