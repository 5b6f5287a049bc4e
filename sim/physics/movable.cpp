#include "sim/physics/movable.h"

namespace sim::physics {
namespace {

struct Extents {
  hal::Vec3 operator()(const MovableBox& box) const { return box.size; }
  hal::Vec3 operator()(const MovableCylinder& cylinder) const {
    return {2 * cylinder.radius, 2 * cylinder.radius, cylinder.height};
  }
  hal::Vec3 operator()(const MovableSphere& sphere) const {
    return {2 * sphere.radius, 2 * sphere.radius, 2 * sphere.radius};
  }
};

}  // namespace

hal::Vec3 extents(const Movable& movable) { return std::visit(Extents{}, movable.form); }

}  // namespace sim::physics
