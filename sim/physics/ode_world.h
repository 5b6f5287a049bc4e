#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <cstdint>

#include "sim/physics/world.h"

namespace sim::physics {

/// Categories of geometries that are tested against each other. Wheels and the ground are not in
/// the space: wheels touch only the ground, and the ground would form a pair with everything.
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

  /// The ground near a place, for contact tests: its tangent plane there. Valid until the next
  /// call.
  dGeomID ground_plane(hal::Vec2 at) const;

  /// Removes all contact joints at the end of a step. @param awake  number of awake objects; when
  /// it has fallen below half of its maximum, the memory of the joints is freed.
  void drop_contacts(std::size_t awake);

  /// Take one step by the exact solver, or by the iterative one seeded with `seed`. Both count
  /// ODE's messages.
  void solve_exactly(double seconds);
  void solve_iteratively(double seconds, std::uint32_t seed);

  std::uint64_t messages() const { return messages_; }
  /// @param count  an earlier messages(): those of a step that is repeated do not count.
  void forget_messages_since(std::uint64_t count) { messages_ = count; }

  /// Sets the number of iterations of the iterative solver; at first 20.
  void set_iterations(int count) const { dWorldSetQuickStepNumIterations(dynamics_, count); }

 private:
  dThreadingImplementationID threading_;
  dWorldID dynamics_;
  dSpaceID space_;
  dJointGroupID contacts_;
  std::shared_ptr<const Ground> ground_;
  dGeomID ground_plane_;
  std::uint64_t messages_ = 0;
  std::size_t most_awake_ = 0;  ///< Since the memory of contacts was last freed.
};

}  // namespace sim::physics
