#include "sim/agents/surroundings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sim::agents {
namespace {

constexpr double kLossPerWall = 9.0;   // dB, Sommer et al. 2011, table II
constexpr double kLossPerMetre = 0.4;  // dB/m, likewise

/// Distance from a point to a fixed upright box, seen from above; 0 inside. m
double distance(hal::Vec2 point, const physics::Shape& box) {
  const hal::Vec2 d = point - box.centre;
  const double along = std::abs(hal::dot(d, box.axis)) - box.half.x;
  const double across = std::abs(hal::dot(d, {-box.axis.y, box.axis.x})) - box.half.y;
  const double x = std::max(along, 0.0), y = std::max(across, 0.0);
  return std::sqrt(x * x + y * y);
}

}  // namespace

Scene::Scene(const physics::World& world, const std::vector<hal::AgentId>& agents)
    : world_(world), proximity_(world) {
  for (const hal::AgentId agent : agents) positions_.push_back({agent, {}});
  for (const physics::Shape& shape : world.shapes())
    if (shape.is_static()) walls_.push_back(shape);
}

const sensing::Proximity& Scene::proximity() {
  if (proximity_at_ != world_.steps()) proximity_.update();
  proximity_at_ = world_.steps();
  return proximity_;
}

std::span<const sensing::AgentPosition> Scene::positions() {
  if (positions_at_ != world_.steps()) {
    for (sensing::AgentPosition& entry : positions_) {
      const hal::Vec3 p = world_.position(entry.agent);
      entry.position = {p.x, p.y};
    }
  }
  positions_at_ = world_.steps();
  return positions_;
}

BodyState Scene::body(hal::AgentId agent) const {
  const physics::BodyPose pose = world_.pose(agent);
  BodyState state{.x = pose.position.x,
                  .y = pose.position.y,
                  .theta = pose.heading,
                  .tilt = pose.tilt,
                  .clearance = std::numeric_limits<double>::infinity()};
  for (const physics::Shape& wall : walls_)
    state.clearance = std::min(state.clearance, distance({state.x, state.y}, wall));
  return state;
}

hal::Vec3 BodyPositions::position(hal::AgentId agent, hal::Time) const {
  return world_.position(agent);
}

hal::Vec3 BodyPositions::velocity(hal::AgentId agent, hal::Time) const {
  return world_.velocity(agent).linear;
}

hal::Time BodyPositions::valid_until(hal::AgentId, hal::Time) const {
  return max_speed_ > 0 ? world_.now() + world_.config().step : hal::Time::max();
}

double BodyPositions::max_speed(hal::AgentId) const { return max_speed_; }

hal::Decibels WallObstacles::loss(const hal::Vec3& from, const hal::Vec3& to) const {
  const sensing::Crossing crossing = line_of_sight_.between(from, to);
  return hal::Decibels{kLossPerWall * crossing.walls + kLossPerMetre * crossing.thickness};
}

}  // namespace sim::agents
