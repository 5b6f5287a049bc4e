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
/// infrared      range               m               one per sensor; NaN: nothing within reach
/// infrared_volts voltage            V               one per sensor, as the converter saw it
/// odometry      odometry            m, rad, m/s     x, y, theta since start; vx, vy, omega in body
/// localisation  relative_position   address, m      triples (address, x, y), body frame, by
///                                                   address
/// scan          scan                m               one per ray; NaN: nothing within `high`,
///                                                   -infinity: nearer than `low`
/// pose          pose                m, rad          x, y, heading in the world
/// bumper        bumper              1               1: touched since the reading before, else 0
/// battery       battery             1, V, A, J, J   charge 0..1; voltage; current drawn; energy in
///                                                   it now, and when it is full
/// imu           imu                 rad/s, m/s^2    rate of turn x, y, z; specific force x, y, z
/// sonar         sonar               m               as one of scan
///
/// The first four are there if the agent has such devices; those of `sensors:` in its file have the
/// names that the file gives them.
struct Channel {
  std::uint16_t id = 0;
  std::string name;
  std::string kind;
  std::string unit;
  std::uint32_t length = 0;  ///< Number of values; 0: it varies from reading to reading.
  Duration period{};         ///< Between samples; zero: sampled when the control cycle asks.
  std::string frame;         ///< "base" or the link that carries the sensor.
  std::vector<double>
      headings;              ///< rad in `frame`, per value, of range, scan; sonar: two, its edges.
  double low = 0, high = 0;  ///< What it can measure, in `unit`; 0, 0: not said.
  Vec3 position;             ///< m in "base", of the origin of a frame of its own
  double heading = 0;        ///< rad in "base", of the x axis of a frame of its own
  bool operator==(const Channel&) const = default;
};

}  // namespace hal
