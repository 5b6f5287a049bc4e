#pragma once

#include <cstdint>

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"

namespace sim::physics {

/// Upright cylinder or box of the world, as sensors and radio obstacles see it. World frame, SI.
/// A body that is not exactly upright is represented by its nearest upright pose.
struct Shape {
  enum class Kind : std::uint8_t { kCylinder, kBox };

  Kind kind = Kind::kBox;
  hal::AgentId owner;    ///< 0: a wall or another fixed thing.
  hal::Vec2 centre;      ///< m
  hal::Vec2 axis{1, 0};  ///< Unit vector of a box's own x.
  hal::Vec2 half;        ///< m; half lengths of a box along its own x and y.
  double radius = 0;     ///< m; of a cylinder.
  double z_low = 0;      ///< m
  double z_high = 0;     ///< m

  bool is_static() const { return owner == hal::AgentId{}; }
};

}  // namespace sim::physics
