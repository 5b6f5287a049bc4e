#pragma once

#include <cstdint>

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"

namespace sim::physics {

/// Upright cylinder or box of the world, or a sphere, as seen by sensors and radio obstacles. World
/// frame, SI. A body that is not exactly upright is represented by its nearest upright pose.
struct Shape {
  enum class Kind : std::uint8_t { kCylinder, kBox, kSphere };

  Kind kind = Kind::kBox;
  hal::AgentId owner;       ///< 0: not of an agent.
  hal::Vec2 centre;         ///< m
  hal::Vec2 axis{1, 0};     ///< Unit vector of a box's x axis.
  hal::Vec2 half;           ///< m; half lengths of a box along its own axes
  double radius = 0;        ///< m; of a cylinder or sphere
  double z_low = 0;         ///< m
  double z_high = 0;        ///< m
  bool is_movable = false;  ///< Of a movable, which has only this shape.

  /// A wall or another object that never moves.
  bool is_static() const { return owner == hal::AgentId{} && !is_movable; }
  /// Whether both are shapes of the same robot or mote.
  bool is_of_body(const Shape& other) const {
    return owner == other.owner && owner != hal::AgentId{};
  }
};

}  // namespace sim::physics
