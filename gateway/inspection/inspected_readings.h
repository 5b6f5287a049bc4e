#pragma once

#include <optional>
#include <span>

#include "gateway/inspection/inspector.h"
#include "hal/node/devices/channels.h"
#include "hal/types/channel.h"
#include "hal/types/time.h"

namespace gateway::inspection {

/// The topic on which readings of a channel are published to DDS tools; none: not published.
inline std::optional<Inspector::Topic> topic_of(const hal::Channel& channel) {
  if (channel.kind == "range") return Inspector::Topic::kRange;
  if (channel.kind == "odometry") return Inspector::Topic::kOdometry;
  if (channel.id >= hal::node::devices::kFirstSensor) return Inspector::Topic::kChannels;
  return std::nullopt;
}

/// Publishes a reading of a channel of a simulated or real robot.
/// @param at  time stamp.
/// @param robot  index of the robot among those of the inspector.
inline void publish_reading(Inspector& inspector, hal::Time at, std::size_t robot,
                            const hal::Channel& channel, std::span<const double> values) {
  const auto topic = topic_of(channel);
  if (topic == Inspector::Topic::kRange) inspector.publish_ranges(at, robot, values);
  if (topic == Inspector::Topic::kChannels)
    inspector.publish_channel(at, robot, channel.id, values);
  if (topic != Inspector::Topic::kOdometry) return;
  inspector.publish_odometry(at, robot, {values[0], values[1], values[2]},
                             {values[3], values[4], values[5]});
}

}  // namespace gateway::inspection
