#pragma once

#include <array>
#include <memory>

#include "hal/node/devices/imu.h"
#include "hal/node/devices/sensor.h"
#include "sim/sensing/sensor_site.h"

namespace sim::sensing {

/// What an inertial sensor goes through between two readings. World frame, SI.
struct InertialMotion {
  hal::Vec3 velocity_before;  ///< Of the sensor's place, and
  hal::Vec3 velocity;         ///< now.
  hal::Vec3 angular;          ///< Now.
  hal::Vec3 gravity;          ///< m/s^2
  double seconds = 0;         ///< > 0
};

/// Angular velocity and mean specific force (v - v_before) / seconds - gravity, in the frame of the
/// sensor; the force in the frame that it had amid the interval, so that on a circle it points
/// inward. @param attitude  now, w, x, y, z: sensor to world.
std::array<double, 6> inertial_values(const InertialMotion& motion,
                                      const std::array<double, 4>& attitude);

/// Inertial sensor at its place on the body.
std::unique_ptr<hal::node::devices::Sensor> simulated(const hal::node::devices::ImuSensor& imu,
                                                      const SensorSite& site);

}  // namespace sim::sensing
