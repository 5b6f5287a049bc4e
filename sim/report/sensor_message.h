#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "hal/types/channel.h"

namespace sim::report {

struct SensorMessage {
  std::string_view type;  ///< "sensor_msgs/msg/LaserScan"
  std::string bytes;      ///< In CDR.
};

/// A reading of a sensor of `sensors:` as the message of ROS 2 that its kind has, as a run under
/// way shows it (hal/dds/inspection/channel_writer.h).
/// @param agent  its name.  @return none: its kind has none, or it has another number of values.
std::optional<SensorMessage> sensor_message(std::int64_t at_ns, const std::string& agent,
                                            const hal::Channel& channel,
                                            std::span<const double> values);

}  // namespace sim::report
