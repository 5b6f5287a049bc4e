#pragma once

#include <memory>

#include "hal/types/geometry.h"

namespace sim {

/// The surface on which bodies, walls and antennas stand. z = 0 is only the origin of the world
/// frame: code that needs the height of the ground asks here. Immutable; any thread.
class Ground {
 public:
  virtual ~Ground() = default;
  /// m, world frame, z of the surface at a place seen from above.
  virtual double height(hal::Vec2 at) const = 0;
  /// Unit vector out of the ground there, world frame; its z is above 0.
  virtual hal::Vec3 normal(hal::Vec2 at) const = 0;
};

/// The plane z = 0.
class FlatGround final : public Ground {
 public:
  double height(hal::Vec2 /*at*/) const override { return 0; }
  hal::Vec3 normal(hal::Vec2 /*at*/) const override { return {0, 0, 1}; }
};

/// The default.
inline const std::shared_ptr<const Ground> kFlatGround = std::make_shared<FlatGround>();

/// The point of the ground below or above a place.
inline hal::Vec3 on(const Ground& ground, hal::Vec2 at) { return {at.x, at.y, ground.height(at)}; }

}  // namespace sim
