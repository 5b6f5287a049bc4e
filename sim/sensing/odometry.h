#pragma once

#include "hal/node/devices/channels.h"
#include "hal/node/devices/odometry.h"
#include "hal/node/devices/sensor.h"
#include "sim/sensing/sensor_site.h"

namespace sim::sensing {

/// Dead reckoning of a simulated robot from the angles of its wheels, as a sensor channel.
class Odometry final : public hal::node::devices::Sensor {
 public:
  /// @param encoder_steps  per revolution of a wheel; 0: continuous angles.
  Odometry(const SensorSite& site, int encoder_steps)
      : site_(site), odometry_(site.world.drive(site.agent), encoder_steps) {}

  /// Call at each control instant, whether or not the channel is read.
  void advance(hal::Time at) {
    if (at > updated_at_) update(odometry_, at);
    updated_at_ = at;
  }
  /// Pose estimate if the wheels were read now, in the frame of the start pose.
  hal::Pose2 reckoned(hal::Time now) const {
    hal::node::devices::WheelOdometry then = odometry_;
    if (now > updated_at_) update(then, now);
    return then.pose();
  }

  hal::Channel describe() const override { return hal::node::devices::odometry_channel(); }
  /// As of the last advance().
  std::optional<std::vector<double>> sample(hal::Time) override {
    return hal::node::devices::odometry_values(odometry_.pose(), odometry_.twist());
  }

 private:
  void update(hal::node::devices::WheelOdometry& odometry, hal::Time at) const {
    odometry.update(site_.world.wheel_angles(site_.agent), at - updated_at_);
  }

  SensorSite site_;
  hal::node::devices::WheelOdometry odometry_;
  hal::Time updated_at_{};
};

}  // namespace sim::sensing
