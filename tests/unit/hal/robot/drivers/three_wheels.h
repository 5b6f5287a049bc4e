#pragma once

#include <vector>

#include "hal/node/devices/robot_description.h"
#include "hal/types/math.h"

namespace hal::robot::drivers {

/// Wheels of 4 cm at 132 mm, 60, 180 and 300 degrees, motors of 3600 rpm behind gears of 16.
inline std::vector<node::devices::Wheel> three_wheels() {
  std::vector<node::devices::Wheel> wheels;
  for (const double degrees : {60.0, 180.0, 300.0}) {
    const double bearing = degrees * math::kPi / 180;
    node::devices::Wheel wheel;
    wheel.position = {0.132 * math::cos(bearing), 0.132 * math::sin(bearing)};
    wheel.axle_heading = bearing;
    wheel.radius = 0.04;
    wheel.mass = 0.2;
    wheel.max_torque = 1;
    wheel.max_speed = 23.56;
    wheels.push_back(wheel);
  }
  return wheels;
}

}  // namespace hal::robot::drivers
