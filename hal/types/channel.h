#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/types/time.h"

namespace hal {

/// A stream of readings that an agent offers. A new sensor needs a new channel, not a new type.
///
/// name          kind                unit            values
/// infrared      range               m               one per sensor; NaN: nothing within reach
/// infrared_volts voltage            V               one per sensor, as the converter saw it
/// odometry      odometry            m, rad, m/s     x, y, theta since start; vx, vy, omega in body
/// localisation  relative_position   address, m      triples (address, x, y), body frame, by
/// address
struct Channel {
  std::uint16_t id = 0;
  std::string name;
  std::string kind;
  std::string unit;
  std::uint32_t length = 0;      ///< Number of values; 0: it varies from reading to reading.
  Duration period{};             ///< Between samples; zero: sampled when the control cycle asks.
  std::string frame;             ///< "base" or the link that carries the sensor.
  std::vector<double> headings;  ///< rad in `frame`, one per value, for kind range; else empty.
  bool operator==(const Channel&) const = default;
};

}  // namespace hal
