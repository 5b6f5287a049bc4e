#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hal/types/check.h"
#include "sim/physics/awake_list.h"
#include "sim/physics/body_states.h"
#include "sim/physics/contact_pass.h"
#include "sim/physics/jam_guard.h"
#include "sim/physics/object.h"
#include "sim/physics/ode_world.h"
#include "sim/physics/world.h"

namespace sim::physics {

/// @throws std::invalid_argument  with what a value is and what is allowed.
void require(bool holds, const char* what, double value, const char* allowed);

/// What a world consists of, and its step.
class World::Implementation {
 public:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  explicit Implementation(const WorldConfig& given);

  bool has(AgentId agent) const {
    return agent.value < index.size() && index[agent.value] != kNone;
  }
  Object& at(AgentId agent) {
    BARAKA_CHECK(has(agent));
    return *objects[index[agent.value]];
  }

  Object& movable(std::size_t number) {
    BARAKA_CHECK(number < movables.size());
    return *objects[movables[number]];
  }

  Object& insert(AgentId agent);
  Object& insert_movable();
  void adopt(dGeomID geometry, const Solid& solid, const Object* owner);
  /// @param object  the last one inserted.
  void furnish(Object& object, Solid::Kind kind, const Geometries& geometries);
  void step();
  void put_down();
  void actuate();
  Solved solve_with_movables(const Solve& how);
  void follow_movable(std::size_t object);
  bool follow(std::size_t object);
  void outdate(std::size_t object);
  std::span<const Shape> refreshed_shapes();
  void look_for_loss(Object& object, hal::Vec3& origin);
  hal::Result<Drivetrain*> drivetrain(AgentId agent);

  const WorldConfig config;
  OdeWorld ode;
  Objects objects;
  /// Index of each agent's object, by address; kNone: no such agent.
  std::vector<std::size_t> index;
  std::deque<Solid> solids;  ///< A deque, because geometries point to its elements.
  std::vector<Shape> shapes;
  std::vector<std::uint8_t> is_outdated;  ///< By object: its shapes are from an earlier step.
  std::vector<std::size_t> outdated;      ///< Objects whose shapes are outdated.
  std::vector<hal::Vec3> origins;         ///< m; of the objects, in their order
  std::vector<std::uint64_t> moved_at;    ///< For each object: last step that may have moved it.
  AwakeList awake;
  std::vector<std::size_t> robots;            ///< Objects with wheels, in ascending order.
  std::vector<AgentId> moved;                 ///< Agents that were awake after the last step.
  std::vector<std::size_t> movables;          ///< Objects, by the movable's number.
  std::vector<std::uint32_t> moved_movables;  ///< As `moved`.
  BodyStates states;                          ///< Before the step, if there are movables.
  ContactPass pass;
  std::uint64_t steps = 0;
  std::uint64_t jams = 0;
  int largest_exact = 0;
  std::vector<LostBody> lost;
  /// Objects and poses, for the next step.
  std::vector<std::pair<std::size_t, hal::Pose2>> placed;
};

}  // namespace sim::physics
