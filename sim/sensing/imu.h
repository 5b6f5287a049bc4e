#pragma once

#include <array>
#include <memory>

#include "hal/node/devices/imu.h"
#include "hal/node/devices/sensor.h"
#include "sim/sensing/sensor_site.h"

namespace sim::sensing {

/// Motion of an inertial sensor between two readings. World frame, SI.
struct InertialMotion {
  hal::Vec3 velocity_before;  ///< Velocity of the sensor at the previous reading.
  hal::Vec3 velocity;         ///< Velocity of the sensor now.
  hal::Vec3 angular;          ///< Angular velocity now.
  hal::Vec3 gravity;          ///< m/s^2
  double seconds = 0;         ///< > 0
};

/// Angular velocity and mean specific force (v - v_before) / seconds - gravity, in the frame of the
/// sensor. The force is in the frame that the sensor had in the middle of the interval, so that on
/// a circle it points inward. @param attitude  now, w, x, y, z: sensor to world.
std::array<double, 6> inertial_values(const InertialMotion& motion,
                                      const std::array<double, 4>& attitude);

/// Inertial sensor at its mounting point on the body.
std::unique_ptr<hal::node::devices::Sensor> simulated(const hal::node::devices::ImuSensor& imu,
                                                      const SensorSite& site);

}  // namespace sim::sensing
