#pragma once

#include "gateway/runtime/object_of.h"

namespace gateway::runtime {

/// The Robot of one agent.
class RobotObject : public ObjectOf<hal::Robot> {
 public:
  using ObjectOf<hal::Robot>::ObjectOf;

  const hal::RobotBody& body() const override;
  hal::Result<hal::Drive> set_body_velocity(const hal::Twist2& twist) override;
  hal::Result<void> set_wheel_speeds(std::span<const double> speeds) override;
  hal::Result<std::vector<hal::InfraredReading>> infrared() const override;
  hal::Result<hal::Odometry> odometry() const override;
  hal::Result<hal::Scan> scan() const override;
  hal::Result<hal::Imu> imu() const override;
  hal::Result<bool> bumped() const override;
  hal::Result<hal::Pose2> pose() const override;

 private:
  /// Errors: kNotAvailable (as Readings::values; or a wrong number of values).
  hal::Result<std::span<const double>> values(const char* channel, std::size_t count) const;
};

}  // namespace gateway::runtime
