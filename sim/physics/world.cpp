#include "sim/physics/world.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <stdexcept>
#include <vector>

#include "hal/types/check.h"
#include "sim/physics/awake_list.h"
#include "sim/physics/body_loss.h"
#include "sim/physics/body_states.h"
#include "sim/physics/contact_pass.h"
#include "sim/physics/displace.h"
#include "sim/physics/jam_guard.h"
#include "sim/physics/movable_body.h"
#include "sim/physics/object.h"
#include "sim/physics/ode_world.h"

namespace sim::physics {

using hal::Errc;
using hal::Result;
using hal::Twist2;
using hal::node::devices::WheelDrive;

namespace {

/// Of the iterative solver, with movables: with the default of 20, stacks of four creep.
constexpr int kIterations = 100;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

void require(bool holds, const char* what, double value, const char* allowed) {
  if (!holds) throw std::invalid_argument(fmt::format("{}: {}, allowed {}", what, value, allowed));
}

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

bool is_finite(const Twist2& twist) {
  return std::isfinite(twist.vx) && std::isfinite(twist.vy) && std::isfinite(twist.omega);
}

Shape::Kind kind_of(dGeomID geometry) {
  if (dGeomGetClass(geometry) == dSphereClass) return Shape::Kind::kSphere;
  return dGeomGetClass(geometry) == dBoxClass ? Shape::Kind::kBox : Shape::Kind::kCylinder;
}

}  // namespace

class World::Implementation {
 public:
  explicit Implementation(const WorldConfig& given)
      : config(checked(given)), ode(config), pass(ode, objects, awake, config.ground_friction) {}

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
    return hal::fail(Errc::kNotAvailable, fmt::format("agent {} has no wheels", agent.value));
  return object.drivetrain.get();
}

World::World(const WorldConfig& config)
    : implementation_(std::make_unique<Implementation>(config)) {}

World::~World() = default;

void World::add_wall(const StaticBox& wall) {
  const dGeomID geometry = make_wall(implementation_->ode, wall);
  implementation_->adopt(geometry, {Solid::Kind::kWall, 0, wall.friction}, nullptr);
  implementation_->pass.add_wall(geometry, implementation_->shapes.back());
}

void World::add_mote(AgentId agent, const hal::node::devices::MoteDescription& mote,
                     const hal::Pose2& pose, double height) {
  require(height >= 0 && std::isfinite(height), "mote height [m]", height, "0 or more");
  Object& object = implementation_->insert(agent);
  Geometries geometries;
  object.rigid = make_mote(implementation_->ode, mote, pose, geometries);
  lift(object.rigid, height);
  object.bodies = {object.rigid.body};
  object.friction = mote.friction;
  implementation_->furnish(object, Solid::Kind::kMote, geometries);
}

void World::add_robot(AgentId agent, const hal::node::devices::RobotDescription& robot,
                      const hal::Pose2& pose) {
  Object& object = implementation_->insert(agent);
  Geometries geometries;
  object.rigid = make_chassis(implementation_->ode, robot, pose, geometries);
  object.drivetrain = std::make_unique<Drivetrain>(implementation_->ode, object.rigid, robot,
                                                   implementation_->config);
  object.bodies = object.drivetrain->bodies();
  object.friction = robot.friction;
  implementation_->furnish(object, Solid::Kind::kRobot, geometries);
}

void World::add_movable(const Movable& movable) {
  Geometries geometries;
  const RigidBody rigid = make_movable(implementation_->ode, movable, geometries);
  Object& object = implementation_->insert_movable();
  object.rigid = rigid;
  object.bodies = {object.rigid.body};
  object.friction = movable.friction;
  const WorldConfig& c = implementation_->config;
  object.rubbing = {.softness = softness(movable),
                    .rolling = rolling_lever(movable),
                    .is_round = std::holds_alternative<MovableSphere>(movable.form),
                    .pull = hal::to_seconds(c.step) * c.gravity * c.down,
                    .push = {}};
  implementation_->furnish(object, Solid::Kind::kMovable, geometries);
  implementation_->ode.set_iterations(kIterations);
}

hal::Result<WheelDrive::Limited> World::set_body_velocity(AgentId agent, const Twist2& twist) {
  auto drivetrain = implementation_->drivetrain(agent);
  if (!drivetrain) return tl::unexpected(drivetrain.error());
  if (!is_finite(twist))
    return hal::fail(
        Errc::kInvalidArgument,
        fmt::format("body velocity ({}, {}, {}): must be finite", twist.vx, twist.vy, twist.omega));
  const WheelDrive::Limited limited = (*drivetrain)->drive().saturate(twist);
  (*drivetrain)->command(limited.twist);
  return limited;
}

hal::Result<void> World::set_wheel_speeds(AgentId agent, std::span<const double> speeds) {
  auto drivetrain = implementation_->drivetrain(agent);
  if (!drivetrain) return tl::unexpected(drivetrain.error());
  const WheelDrive& drive = (*drivetrain)->drive();
  if (speeds.size() != drive.wheel_count())
    return hal::fail(Errc::kInvalidArgument, fmt::format("{} wheel speeds for {} wheels",
                                                         speeds.size(), drive.wheel_count()));
  for (const double speed : speeds)
    if (!(std::abs(speed) <= drive.max_wheel_speed()))
      return hal::fail(
          Errc::kInvalidArgument,
          fmt::format("wheel speed {} rad/s: at most {} allowed", speed, drive.max_wheel_speed()));
  (*drivetrain)->command(drive.body_velocity(speeds));
  return {};
}

hal::Result<void> World::set_motors(AgentId agent, bool on) {
  auto drivetrain = implementation_->drivetrain(agent);
  if (!drivetrain) return tl::unexpected(drivetrain.error());
  (*drivetrain)->set_power(on);
  return {};
}

void World::place(AgentId agent, const hal::Pose2& pose) {
  BARAKA_CHECK(has(agent) && std::isfinite(pose.x) && std::isfinite(pose.y) &&
               std::isfinite(pose.theta));
  implementation_->placed.emplace_back(implementation_->index[agent.value], pose);
}

void World::step() { implementation_->step(); }

const WorldConfig& World::config() const { return implementation_->config; }

std::uint64_t World::steps() const { return implementation_->steps; }

hal::Time World::now() const {
  return hal::Time{} + implementation_->config.step * static_cast<std::int64_t>(steps());
}

hal::Vec3 World::position(AgentId agent) const {
  BARAKA_CHECK(has(agent));
  return implementation_->origins[implementation_->index[agent.value]];
}

std::uint64_t World::moved_at(AgentId agent) const {
  BARAKA_CHECK(has(agent));
  return implementation_->moved_at[implementation_->index[agent.value]];
}

BodyPose World::pose(AgentId agent) const {
  const Object& object = implementation_->at(agent);
  if (!object.pose) object.pose = pose_of(object.rigid);
  return *object.pose;
}

BodyVelocity World::velocity(AgentId agent) const {
  return velocity_of(implementation_->at(agent).rigid);
}

const Contacts& World::contacts(AgentId agent) const { return implementation_->at(agent).contacts; }

bool World::asleep(AgentId agent) const { return !implementation_->at(agent).awake(); }

const WheelDrive& World::drive(AgentId agent) const {
  const Object& object = implementation_->at(agent);
  BARAKA_CHECK(object.drivetrain != nullptr);
  return object.drivetrain->drive();
}

std::span<const double> World::wheel_angles(AgentId agent) const {
  const Object& object = implementation_->at(agent);
  BARAKA_CHECK(object.drivetrain != nullptr);
  return object.drivetrain->angles();
}

Energy World::energy(AgentId agent) const {
  const Object& object = implementation_->at(agent);
  Energy energy;
  for (const dBodyID body : object.bodies) {
    energy.kinetic += kinetic_energy(body);
    energy.potential += potential_energy(body);
  }
  if (object.drivetrain == nullptr) return energy;
  energy.motor_work = object.drivetrain->wheels().motor_work();
  energy.friction_loss = object.drivetrain->wheels().friction_loss();
  energy.motor_input = object.drivetrain->wheels().motor_input();
  return energy;
}

double World::motor_input(AgentId agent) const {
  const Object& object = implementation_->at(agent);
  BARAKA_CHECK(object.drivetrain != nullptr);
  return object.drivetrain->wheels().motor_input();
}

int World::largest_exact_heap() const { return implementation_->largest_exact; }

double World::deepest_overlap() const { return implementation_->pass.deepest_overlap(); }

bool World::has(AgentId agent) const { return implementation_->has(agent); }

std::size_t World::movable_count() const { return implementation_->movables.size(); }

MovableState World::movable(std::size_t number) const {
  const Object& object = implementation_->movable(number);
  if (!object.pose) object.pose = pose_of(object.rigid);
  return {*object.pose, velocity_of(object.rigid), !object.awake()};
}

const Contacts& World::movable_contacts(std::size_t number) const {
  return implementation_->movable(number).contacts;
}

const Shape& World::movable_shape(std::size_t number) const {
  return shapes()[implementation_->movable(number).first_shape];
}

std::span<const std::uint32_t> World::moved_movables() const {
  return implementation_->moved_movables;
}

std::span<const LostBody> World::lost_bodies() const { return implementation_->lost; }

std::span<const AgentId> World::moved() const { return implementation_->moved; }

std::span<const Shape> World::shapes_of(AgentId agent) const {
  const Object& object = implementation_->at(agent);
  return shapes().subspan(object.first_shape, object.geometries.size());
}

std::span<const Shape> World::shapes() const { return implementation_->refreshed_shapes(); }

std::uint64_t World::solver_messages() const { return implementation_->ode.messages(); }

std::uint64_t World::jammed_steps() const { return implementation_->jams; }

}  // namespace sim::physics
