#include "sim/physics/world_implementation.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/physics/body_loss.h"
#include "sim/physics/displace.h"

namespace sim::physics {
namespace {

const WorldConfig& checked(const WorldConfig& config) {
  using namespace std::chrono_literals;
  require(config.step > 0ms && config.step <= 20ms, "physics step [s]",
          hal::to_seconds(config.step), "above 0, at most 0.02");
  require(config.gravity >= 0 && std::isfinite(config.gravity), "gravity [m/s^2]", config.gravity,
          "0 or more");
  require(std::abs(hal::dot(config.down, config.down) - 1) < 1e-9, "length of `down`",
          std::sqrt(hal::dot(config.down, config.down)), "1");
  require(config.erp > 0 && config.erp <= 1, "erp", config.erp, "above 0, at most 1");
  require(config.cfm >= 0 && config.cfm < 1, "cfm", config.cfm, "0 or more, below 1");
  require(config.surface_layer >= 0, "surface layer [m]", config.surface_layer, "0 or more");
  require(config.max_correcting_velocity > 0, "max correcting velocity [m/s]",
          config.max_correcting_velocity, "above 0");
  require(config.ground_friction >= 0, "ground friction", config.ground_friction, "0 or more");
  require(config.jam_contacts >= 0, "jam contacts", config.jam_contacts, "0 or more");
  require(config.jam_robots >= 1, "jam robots", config.jam_robots, "1 or more");
  if (config.ground == nullptr) throw std::invalid_argument("ground: none, needed");
  return config;
}

Shape::Kind kind_of(dGeomID geometry) {
  if (dGeomGetClass(geometry) == dSphereClass) return Shape::Kind::kSphere;
  return dGeomGetClass(geometry) == dBoxClass ? Shape::Kind::kBox : Shape::Kind::kCylinder;
}

}  // namespace

void require(bool holds, const char* what, double value, const char* allowed) {
  if (!holds) throw std::invalid_argument(fmt::format("{}: {}, allowed {}", what, value, allowed));
}

World::Implementation::Implementation(const WorldConfig& given)
    : config(checked(given)), ode(config), pass(ode, objects, awake, config.ground_friction) {}

Object& World::Implementation::insert(AgentId agent) {
  if (agent == AgentId{} || has(agent))
    throw std::invalid_argument(fmt::format("agent {} cannot be added: 0 or twice", agent.value));
  if (agent.value >= index.size()) index.resize(agent.value + 1u, kNone);
  index[agent.value] = objects.size();
  objects.push_back(std::make_unique<Object>());
  objects.back()->agent = agent;
  return *objects.back();
}

Object& World::Implementation::insert_movable() {
  objects.push_back(std::make_unique<Object>());
  objects.back()->movable = static_cast<std::uint32_t>(movables.size());
  movables.push_back(objects.size() - 1);
  return *objects.back();
}

/// @param owner  null: a wall.
void World::Implementation::adopt(dGeomID geometry, const Solid& solid, const Object* owner) {
  dGeomSetData(geometry, &solids.emplace_back(solid));
  Shape& shape = shapes.emplace_back();
  shape.kind = kind_of(geometry);
  if (owner != nullptr) shape.owner = owner->agent;
  shape.is_movable = solid.kind == Solid::Kind::kMovable;
  refresh(shape, geometry);
}

void World::Implementation::furnish(Object& object, Solid::Kind kind,
                                    const Geometries& geometries) {
  object.geometries = geometries.all;
  object.first_shape = shapes.size();
  const dReal* p = dBodyGetPosition(object.rigid.body);
  object.centre = {p[0], p[1], p[2]};
  const std::size_t place = objects.size() - 1;
  const Solid solid{kind, place, object.friction};
  for (const dGeomID geometry : geometries.all) adopt(geometry, solid, &object);
  origins.push_back(position_of(object.rigid));
  moved_at.push_back(0);
  is_outdated.push_back(0);
  awake.add(place);
  if (object.drivetrain != nullptr) robots.push_back(place);
}

/// Sets the motors; a command also wakes a robot.
void World::Implementation::actuate() {
  for (const std::size_t robot : robots) {
    Object& object = *objects[robot];
    if (object.frozen) continue;
    object.drivetrain->actuate(config.step);
    if (object.awake()) awake.add(robot);
  }
}

/// Moves the objects that were placed since the last step.
void World::Implementation::put_down() {
  for (const auto& [number, pose] : placed) {
    Object& object = *objects[number];
    if (object.frozen) continue;
    displace(object, pose, ode.ground());
    awake.add(number);
  }
  placed.clear();
}

void World::Implementation::step() {
  put_down();
  actuate();
  pass.run(config.step * static_cast<std::int64_t>(steps) + hal::Time{});
  const Solve how{hal::to_seconds(config.step), config.jam_contacts, config.jam_robots, config.seed,
                  steps};
  const Solved solved =
      movables.empty() ? solve(ode, objects, pass.islands(), how) : solve_with_movables(how);
  if (solved.jam) ++jams;
  largest_exact = std::max(largest_exact, solved.largest_exact);
  ode.drop_contacts(awake.members().size());
  ++steps;
  moved.clear();
  moved_movables.clear();
  awake.keep_if([this](std::size_t object) { return follow(object); });
}

/// Updates everything about an object after a step, in one go: there may be thousands of objects,
/// and their data does not stay in the cache for long. A sleeping object has not moved. @return
/// whether it is awake.
bool World::Implementation::follow(std::size_t index_of_object) {
  Object& object = *objects[index_of_object];
  if (!object.awake()) {
    pass.rest(index_of_object);
    return false;
  }
  moved_at[index_of_object] = steps;
  if (object.movable) {
    follow_movable(index_of_object);
  } else {
    moved.push_back(object.agent);
  }
  if (object.drivetrain != nullptr) object.drivetrain->follow(config.step);
  object.pose.reset();
  look_for_loss(object, origins[index_of_object]);
  outdate(index_of_object);
  return true;
}

/// The exact solver gives up on some symmetric stacks and then leaves wrong velocities: such a step
/// is repeated, and the iterative solver solves all groups of touching bodies.
Solved World::Implementation::solve_with_movables(const Solve& how) {
  for (const AwakeList::Member i : awake.members())
    objects[i]->velocity_before = linear_velocity(objects[i]->rigid);
  if (pass.islands().empty()) return solve(ode, objects, pass.islands(), how);
  states.keep(objects, awake.members());
  const std::uint64_t messages = ode.messages();
  const Solved solved = solve(ode, objects, pass.islands(), how);
  if (ode.messages() == messages) return solved;
  states.restore();
  ode.forget_messages_since(messages);
  Solve iteratively = how;
  iteratively.jam_contacts = 0;
  return solve(ode, objects, pass.islands(), iteratively);
}

/// After the step of a movable that is awake.
void World::Implementation::follow_movable(std::size_t index_of_object) {
  Object& object = *objects[index_of_object];
  moved_movables.push_back(*object.movable);
  if (pass.is_alone(index_of_object)) slide(object, ode.ground(), hal::to_seconds(config.step));
  doze(object, pass.islands().total(index_of_object).robots > 0, hal::to_seconds(config.step));
}

void World::Implementation::outdate(std::size_t object) {
  if (is_outdated[object] != 0) return;
  is_outdated[object] = 1;
  outdated.push_back(object);
}

/// Updates shapes on request, because they may not be read for many steps.
std::span<const Shape> World::Implementation::refreshed_shapes() {
  for (const std::size_t index_of_object : outdated) {
    const Object& object = *objects[index_of_object];
    for (std::size_t i = 0; i < object.geometries.size(); ++i)
      refresh(shapes[object.first_shape + i], object.geometries[i]);
    is_outdated[index_of_object] = 0;
  }
  outdated.clear();
  return shapes;
}

/// Checks whether a body was lost. @param origin  is updated.
void World::Implementation::look_for_loss(Object& object, hal::Vec3& origin) {
  origin = position_of(object.rigid);
  const auto loss = loss_of(object.rigid, origin, ode.ground());
  if (loss == BodyLoss::kBlownUp) {
    freeze(object, object.centre);
    origin = position_of(object.rigid);
  } else {
    const dReal* p = dBodyGetPosition(object.rigid.body);
    object.centre = {p[0], p[1], p[2]};
  }
  if (!loss || object.lost || (object.movable && loss == BodyLoss::kTipped)) return;
  object.lost = true;
  lost.push_back({object.agent, *loss, hal::Time{} + config.step * static_cast<std::int64_t>(steps),
                  object.movable});
}

hal::Result<Drivetrain*> World::Implementation::drivetrain(AgentId agent) {
  Object& object = at(agent);
  if (object.drivetrain == nullptr)
    return hal::fail(hal::Errc::kNotAvailable, fmt::format("agent {} has no wheels", agent.value));
  return object.drivetrain.get();
}

}  // namespace sim::physics
