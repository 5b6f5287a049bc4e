#pragma once

#include <cstdint>

#include "sim/physics/contact_islands.h"
#include "sim/physics/object.h"
#include "sim/physics/ode_world.h"

namespace sim::physics {

/// Parameters of a step.
struct Solve {
  double seconds = 0;
  int jam_contacts = 0;    ///< Islands with more contacts are a jam.
  int jam_robots = 0;      ///< Islands with more robots are a jam, too.
  std::uint64_t seed = 0;  ///< Seed of the run.
  std::uint64_t step = 0;  ///< Number of the step; with `seed`, it seeds the iterative solver.
};

/// Result of solve().
struct Solved {
  bool jam = false;       ///< There was a jam.
  int largest_exact = 0;  ///< Contacts of the largest island that the exact solver solved.
};
/// Advances a world by one step: separate robots by the exact solver, which is cheaper for them and
/// follows commands; jams by the iterative one, because the cost of the exact one grows with the
/// cube of an island's size (docs/models.md, 2). Islands share no joints, so the two passes do not
/// interact.
Solved solve(OdeWorld& world, const Objects& objects, ContactIslands& islands, const Solve& how);

}  // namespace sim::physics
