#pragma once

#include <memory>

#include "hal/types/geometry.h"

namespace sim {

/// The surface on which bodies, walls and antennas stand. z = 0 is only the origin of the world
/// frame: code that needs the height of the ground asks here. Immutable; any thread.
class Ground {
 public:
  virtual ~Ground() = default;
  /// Height of the surface (z, world frame) at a horizontal position [m].
  virtual double height(hal::Vec2 at) const = 0;
  /// Unit normal out of the ground at that position, world frame; its z is above 0.
  virtual hal::Vec3 normal(hal::Vec2 at) const = 0;
};

/// The plane z = 0.
class FlatGround final : public Ground {
 public:
  double height(hal::Vec2 /*at*/) const override { return 0; }
  hal::Vec3 normal(hal::Vec2 /*at*/) const override { return {0, 0, 1}; }
};

/// The ground where none is given.
inline const std::shared_ptr<const Ground> kFlatGround = std::make_shared<FlatGround>();

/// Point of the ground at a horizontal position.
inline hal::Vec3 on(const Ground& ground, hal::Vec2 at) { return {at.x, at.y, ground.height(at)}; }

}  // namespace sim
