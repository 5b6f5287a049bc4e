#pragma once

#include <cstdint>

#include "sim/physics/contact_islands.h"
#include "sim/physics/object.h"
#include "sim/physics/ode_world.h"

namespace sim::physics {

/// How one step is solved.
struct Solve {
  double seconds = 0;
  int jam_contacts = 0;    ///< Islands with more contacts …
  int jam_robots = 0;      ///< … or more robots are a jam.
  std::uint64_t seed = 0;  ///< Of the run; with
  std::uint64_t step = 0;  ///< … it seeds the iterative solver.
};

/// Advances a world by one step: separate robots by the exact solver, which is cheaper for them and
/// tracks commands, jams by the iterative one, because the exact one grows with the cube of an
/// island's size (docs/models.md, 2). Islands share no joints, so the passes do not interact.
struct Solved {
  bool jam = false;       ///< There was one.
  int largest_exact = 0;  ///< Contacts of the largest island that the exact solver got.
};
Solved solve(OdeWorld& world, const Objects& objects, ContactIslands& islands, const Solve& how);

}  // namespace sim::physics
