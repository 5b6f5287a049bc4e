#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/node/devices/robot_description.h"
#include "hal/types/channel.h"
#include "hal/types/geometry.h"

namespace hal::node::devices {

/// Catalogue of channels: number, name, kind, unit and encoding of the values, common to simulated
/// and real agents.

inline constexpr std::uint16_t kLocalisation = 0;
inline constexpr std::uint16_t kOdometry = 1;  ///< Only robots.
inline constexpr std::uint16_t kInfrared = 2;  ///< Only robots with infrared sensors.
/// As measured by the converter; only robots with infrared sensors.
inline constexpr std::uint16_t kInfraredVolts = 3;
/// First channel of `sensors:`; the others follow in the file's order. Robots and motes.
inline constexpr std::uint16_t kFirstSensor = 0x10;

Channel localisation_channel();
Channel odometry_channel();

/// Ranges, and the voltages from which they were computed. @param period  between two measurements.
std::array<Channel, 2> infrared_channels(const std::vector<InfraredSensor>& sensors,
                                         Duration period);

/// The channels of `sensors:`.
std::vector<Channel> sensor_channels(const std::vector<SensorDescription>& sensors);

/// Values of the channel odometry.
std::vector<double> odometry_values(const Pose2& pose, const Twist2& twist);

}  // namespace hal::node::devices
