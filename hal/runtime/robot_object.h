#pragma once

#include "hal/runtime/object_of.h"

namespace hal::runtime {

/// The Robot of one agent.
class RobotObject : public ObjectOf<Robot> {
 public:
  using ObjectOf<Robot>::ObjectOf;

  Result<Drive> set_body_velocity(const Twist2& twist) override;
  Result<void> set_wheel_speeds(std::span<const double> speeds) override;
  Result<std::vector<InfraredReading>> infrared() const override;
  Result<Odometry> odometry() const override;
};

}  // namespace hal::runtime
