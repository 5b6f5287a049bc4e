#include "sim/physics/world.h"

#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "sim/physics/displace.h"
#include "sim/physics/movable_body.h"
#include "sim/physics/world_implementation.h"

namespace sim::physics {

using hal::Errc;
using hal::Result;
using hal::Twist2;
using hal::node::devices::WheelDrive;

namespace {

/// Of the iterative solver, with movables: with the default of 20, stacks of four creep.
constexpr int kIterations = 100;

bool is_finite(const Twist2& twist) {
  return std::isfinite(twist.vx) && std::isfinite(twist.vy) && std::isfinite(twist.omega);
}

}  // namespace

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
