#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/types/geometry.h"
#include "hal/types/time.h"

namespace hal {

/// A stream of readings that an agent offers. A new sensor needs a new channel, not a new type.
///
/// name          kind                unit            values
/// infrared      range               m               one per sensor; NaN: nothing within range
/// infrared_volts voltage            V               one per sensor, as the converter measured it
/// odometry      odometry            m, rad, m/s     x, y, theta since start; vx, vy, omega in body
/// localisation  relative_position   address, m      triples (address, x, y), body frame, by
///                                                   address
/// scan          scan                m               one per ray; NaN: nothing within `high`,
///                                                   -infinity: nearer than `low`
/// pose          pose                m, rad          x, y, heading in the world
/// bumper        bumper              1               1: touched since the reading before, else 0
/// battery       battery             1, V, A, J, J   charge 0..1; voltage; current drawn; energy
///                                                   stored now, and when full
/// imu           imu                 rad/s, m/s^2    rate of turn x, y, z; specific force x, y, z
/// sonar         sonar               m               one range, with the special values of a scan
///
/// An agent has the first four channels if it has the devices. Channels of `sensors:` in its file
/// have the names that the file gives them.
struct Channel {
  /// Number of the channel, unique within its agent; numbers need not be consecutive.
  std::uint16_t id = 0;
  /// Unique among the channels of its agent, e.g. "infrared".
  std::string name;
  /// What the values mean: a word of the column `kind` above.
  std::string kind;
  /// Unit of the values, or the units of the values in order, separated by commas, as above.
  std::string unit;
  /// Number of values in a reading; 0: it varies from reading to reading.
  std::uint32_t length = 0;
  /// Time between two samples; zero: sampled at each control instant.
  Duration period{};
  /// "base" (the body), "world", or the link that carries the sensor.
  std::string frame;
  /// Range and scan: rad in `frame`, one per value. Sonar: two, the edges of its cone. Otherwise
  /// empty.
  std::vector<double> headings;
  double low = 0,  ///< Smallest value that the sensor can measure, in `unit`.
      high = 0;    ///< Largest value, in `unit`. Both 0: not specified.
  /// Origin of the sensor's own frame, m in "base"; zero if it has none.
  Vec3 position;
  /// Direction of the x axis of the sensor's own frame, rad in "base", counter-clockwise.
  double heading = 0;
  bool operator==(const Channel&) const = default;  ///< Member by member.
};

}  // namespace hal
