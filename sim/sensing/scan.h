#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hal/node/devices/scan.h"
#include "hal/node/devices/sensor.h"
#include "sim/sensing/sensor_site.h"

namespace sim::sensing {

/// Distance from `origin` to the first surface along each direction, among shapes at its height; 0
/// inside a shape, infinity where nothing is hit. Exact, without iteration.
/// @param origin  m, world frame. @param directions  unit vectors. @param own  shapes of this agent
/// are transparent.
std::vector<double> ray_ranges(const hal::Vec3& origin, std::span<const hal::Vec2> directions,
                               std::span<const physics::Shape> shapes,
                               std::span<const std::size_t> candidates, hal::AgentId own);

/// A laser scanner: all rays at one instant, at its height above the body's origin. Ranges are
/// exact except for noise.
std::unique_ptr<hal::node::devices::Sensor> simulated(const hal::node::devices::ScanSensor& scan,
                                                      const SensorSite& site);

}  // namespace sim::sensing
