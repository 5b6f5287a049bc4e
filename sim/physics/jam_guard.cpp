#include "sim/physics/jam_guard.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "hal/types/random.h"

namespace sim::physics {
namespace {

std::uint32_t solver_seed(const Solve& how) {
  hal::RandomStream stream(how.seed, fmt::format("physics/solver/{}", how.step));
  return static_cast<std::uint32_t>(stream.next());
}

/// Awake bodies, separated by whether their island is a jam.
struct Parts {
  std::vector<dBodyID> free;
  std::vector<dBodyID> jammed;
  int most_contacts = 0;  ///< Largest number in an island that is free.
};

bool is_jam(const ContactIslands::Total& total, const Solve& how) {
  return total.contacts > how.jam_contacts || total.robots > how.jam_robots;
}

/// An island of a single object without contacts is never a jam.
bool holds_jam(ContactIslands& islands, const Solve& how) {
  return std::ranges::any_of(
      islands.touching(), [&](std::size_t object) { return is_jam(islands.total(object), how); });
}

/// Largest number of contacts of an island.
int most_contacts(ContactIslands& islands) {
  int most = 0;
  for (const std::size_t object : islands.touching())
    most = std::max(most, islands.total(object).contacts);
  return most;
}

Parts divide(const Objects& objects, ContactIslands& islands, const Solve& how) {
  Parts parts;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const ContactIslands::Total total = islands.total(i);
    const bool jams = is_jam(total, how);
    auto& part = jams ? parts.jammed : parts.free;
    if (!jams) parts.most_contacts = std::max(parts.most_contacts, total.contacts);
    for (const dBodyID body : objects[i]->bodies)
      if (dBodyIsEnabled(body) != 0) part.push_back(body);
  }
  return parts;
}

}  // namespace

Solved solve(OdeWorld& world, const Objects& objects, ContactIslands& islands, const Solve& how) {
  if (islands.empty()) {
    world.solve_exactly(how.seconds);
    return {};
  }
  if (!holds_jam(islands, how)) {
    world.solve_exactly(how.seconds);
    return {false, most_contacts(islands)};
  }
  const Parts parts = divide(objects, islands, how);
  for (const dBodyID body : parts.jammed) dBodyDisable(body);
  world.solve_exactly(how.seconds);
  // Enabling restarts a body's countdown to sleep: while a jam lasts, no mote elsewhere falls
  // asleep. This costs time, not correctness.
  std::vector<dBodyID> still_awake;
  for (const dBodyID body : parts.free) {
    if (dBodyIsEnabled(body) == 0) continue;
    still_awake.push_back(body);
    dBodyDisable(body);
  }
  for (const dBodyID body : parts.jammed) dBodyEnable(body);
  world.solve_iteratively(how.seconds, solver_seed(how));
  for (const dBodyID body : still_awake) dBodyEnable(body);
  return {true, parts.most_contacts};
}

}  // namespace sim::physics
