#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <cstdint>

#include "sim/physics/world.h"

namespace sim::physics {

/// Which geometries are tested against each other. Wheels and the ground stay out of the space:
/// wheels touch nothing but the ground, and the ground would pair with all.
enum Category : unsigned { kWallBit = 2, kBodyBit = 4, kMoteBit = 16 };

/// Owns ODE's objects of one world: dynamics, broad phase, contact joints, a plane as ground.
class OdeWorld {
 public:
  explicit OdeWorld(const WorldConfig& config);
  ~OdeWorld();
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  dWorldID dynamics() const { return dynamics_; }
  dSpaceID space() const { return space_; }
  dJointGroupID contacts() const { return contacts_; }
  const Ground& ground() const { return *ground_; }

  /// The ground as it is around a place, for geometries to be tested against: the plane that
  /// touches it there. Good until the next call.
  dGeomID ground_plane(hal::Vec2 at) const;

  /// Removes all contact joints: at the end of a step. @param awake  objects that have some; when
  /// there are far fewer than there were, what memory their joints took is given back.
  void drop_contacts(std::size_t awake);

  /// One step by the exact solver, or by the iterative one seeded with `seed`. Counts messages.
  void solve_exactly(double seconds);
  void solve_iteratively(double seconds, std::uint32_t seed);

  std::uint64_t messages() const { return messages_; }

 private:
  dThreadingImplementationID threading_;
  dWorldID dynamics_;
  dSpaceID space_;
  dJointGroupID contacts_;
  std::shared_ptr<const Ground> ground_;
  dGeomID ground_plane_;
  std::uint64_t messages_ = 0;
  std::size_t most_awake_ = 0;  ///< Since the memory of contacts was given back.
};

}  // namespace sim::physics
