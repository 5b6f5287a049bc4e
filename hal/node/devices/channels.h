#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/node/devices/robot_description.h"
#include "hal/types/channel.h"
#include "hal/types/geometry.h"

namespace hal::node::devices {

/// The catalogue of channels: what simulated and real agents offer under one number, name, kind and
/// unit, and the coding of their values.

inline constexpr std::uint16_t kLocalisation = 0;
inline constexpr std::uint16_t kOdometry = 1;       ///< Robots only, as
inline constexpr std::uint16_t kInfrared = 2;       ///< are these, if they have such sensors.
inline constexpr std::uint16_t kInfraredVolts = 3;  ///< As the converter saw it.
inline constexpr std::uint16_t kFirstSensor =
    0x10;  ///< Of those in `sensors:`, in its order; robots and motes.

Channel localisation_channel();
Channel odometry_channel();

/// Ranges, and the volts that they were made from. @param period  between two measurements.
std::array<Channel, 2> infrared_channels(const std::vector<InfraredSensor>& sensors,
                                         Duration period);

/// The channels of `sensors:`.
std::vector<Channel> sensor_channels(const std::vector<SensorDescription>& sensors);

/// Values of the channel odometry.
std::vector<double> odometry_values(const Pose2& pose, const Twist2& twist);

}  // namespace hal::node::devices
