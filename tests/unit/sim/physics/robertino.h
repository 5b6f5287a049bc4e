#pragma once

#include <gtest/gtest.h>

#include <string>

#include "hal/node/devices/robot_description.h"
#include "hal/types/math.h"

namespace sim::physics::test {

/// The Robertino as docs/models.md, 5 describes it: written out here so that the expectations of
/// tests do not follow a change of the shipped robot file.
inline hal::node::devices::RobotDescription robertino(
    hal::node::devices::WheelLevel level = hal::node::devices::WheelLevel::kJointed) {
  using hal::math::kPi;
  hal::node::devices::RobotDescription robot;
  robot.model = "robertino";
  robot.wheel_level = level;
  robot.cylinders = {{0.185, 0.02, 0.21, {}, 9}, {0.10, 0.21, 0.42, {}, 2}};
  for (const double degrees : {60.0, 180.0, 300.0}) {
    const double heading = degrees * hal::math::kPi / 180;
    const hal::Vec2 outward{hal::math::cos(heading), hal::math::sin(heading)};
    robot.wheels.push_back({0.132 * outward, heading, 0.04, 0.2, 0.6, 0.02, 1.0, 23.56});
  }
  for (int i = 0; i < 6; ++i) {
    const double heading = i * hal::math::kPi / 3;
    hal::node::devices::InfraredSensor sensor;
    sensor.position = {0.185 * hal::math::cos(heading), 0.185 * hal::math::sin(heading), 0.04};
    sensor.heading = heading;
    sensor.half_angle = 2.5 * hal::math::kPi / 180;
    sensor.noise_sigma = 0.015;
    sensor.hold_period = hal::Duration{38'300'000};
    robot.infrared.push_back(sensor);
  }
  return robot;
}

/// For tests that hold at both levels: their names end in the level.
inline const auto kLevels = testing::Values(hal::node::devices::WheelLevel::kJointed,
                                            hal::node::devices::WheelLevel::kContact);
inline std::string level_name(const testing::TestParamInfo<hal::node::devices::WheelLevel>& c) {
  return c.param == hal::node::devices::WheelLevel::kJointed ? "Jointed" : "Contact";
}

}  // namespace sim::physics::test
