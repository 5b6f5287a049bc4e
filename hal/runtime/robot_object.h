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
  Result<Scan> scan() const override;
  Result<Imu> imu() const override;
  Result<bool> bumped() const override;
  Result<Pose2> pose() const override;

 private:
  /// Errors: kNotAvailable (as Readings::values; another number of values).
  Result<std::span<const double>> values(const char* channel, std::size_t count) const;
};

}  // namespace hal::runtime
