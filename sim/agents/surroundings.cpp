#include "sim/agents/surroundings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/types/math.h"

namespace sim::agents {
namespace {

/// Edge of a grid cell as a share of the localisation range.
constexpr double kCellShare = 0.5;

/// Horizontal distance from a point to a fixed upright box [m]; 0 inside.
double distance(hal::Vec2 point, const physics::Shape& box) {
  const hal::Vec2 d = point - box.centre;
  const double along = std::abs(hal::dot(d, box.axis)) - box.half.x;
  const double across = std::abs(hal::dot(d, {-box.axis.y, box.axis.x})) - box.half.y;
  const double x = std::max(along, 0.0), y = std::max(across, 0.0);
  return std::sqrt(x * x + y * y);
}

/// Whether a wall stands on the ground: not on another floor.
bool stands_on(const Ground& ground, const physics::Shape& wall) {
  constexpr double kSunk = 1e-6;  // m, by rounding
  const double height = ground.height(wall.centre);
  return wall.z_low <= height + kSunk && wall.z_high > height;
}

}  // namespace

Scene::Scene(const physics::World& world, const std::vector<hal::AgentId>& agents,
             const Paths* paths)
    : world_(world), proximity_(world), paths_(paths) {
  for (const hal::AgentId agent : agents) {
    if (agent.value >= index_.size()) index_.resize(agent.value + 1u, 0);
    index_[agent.value] = static_cast<std::uint32_t>(positions_.size());
    const Path* const path = paths_ == nullptr ? nullptr : paths_->find(agent);
    if (path != nullptr && path->max_speed() > 0) moving_.push_back(index_[agent.value]);
    positions_.push_back({agent, {}});
  }
  known_.resize(index_.size());
  for (const physics::Shape& shape : world.shapes())
    if (shape.is_static() && stands_on(*world.config().ground, shape)) walls_.push_back(shape);
  if (walls_.size() >= physics::WallTree::kFewestWalls) wall_tree_ = physics::WallTree(walls_);
}

const sensing::Proximity& Scene::proximity() {
  if (proximity_at_ != world_.steps()) proximity_.update();
  proximity_at_ = world_.steps();
  return proximity_;
}

std::span<const sensing::AgentPosition> Scene::near(hal::Vec2 point, double range, hal::Time now) {
  if (positions_at_ != world_.steps()) follow(range);
  if (paths_at_ != now) follow_paths(now);
  found_.clear();
  grid_->within({point.x - range, point.y - range}, {point.x + range, point.y + range}, found_);
  near_.clear();
  for (const std::uint32_t i : found_) near_.push_back(positions_[i]);
  return near_;
}

/// Updates the positions and their grid: if one step has passed, only bodies that it moved.
void Scene::follow(double range) {
  const auto put = [this](std::uint32_t i) {
    const hal::AgentId agent = positions_[i].agent;
    const Path* const path = paths_ == nullptr ? nullptr : paths_->find(agent);
    hal::Vec2& place = positions_[i].position;
    if (path != nullptr)
      place = path->at(paths_at_).position;
    else
      place = {world_.position(agent).x, world_.position(agent).y};
    grid_->put(i, place);
  };
  const bool is_one_step_behind = positions_at_ && *positions_at_ + 1 == world_.steps();
  if (is_one_step_behind) {
    for (const hal::AgentId agent : world_.moved()) put(index_[agent.value]);
  } else {
    if (!grid_) grid_.emplace(kCellShare * range);
    for (std::uint32_t i = 0; i < positions_.size(); ++i) put(i);
  }
  positions_at_ = world_.steps();
}

void Scene::follow_paths(hal::Time now) {
  paths_at_ = now;
  for (const std::uint32_t i : moving_) {
    positions_[i].position = paths_->find(positions_[i].agent)->at(now).position;
    grid_->put(i, positions_[i].position);
  }
}

const BodyState& Scene::place(const Path& path, Known& known, hal::Time now) const {
  const PathState at = path.at(now);
  const bool is_elsewhere =
      known.since == kNever || at.position != hal::Vec2{known.state.x, known.state.y};
  known.since = 0;
  known.state = {.x = at.position.x,
                 .y = at.position.y,
                 .theta = at.heading,
                 .tilt = 0,
                 .clearance = is_elsewhere ? clearance(at.position) : known.state.clearance};
  return known.state;
}

const BodyState& Scene::body(hal::AgentId agent, hal::Time now) {
  Known& known = known_[agent.value];
  const Path* const path = paths_ == nullptr ? nullptr : paths_->find(agent);
  if (path != nullptr) return place(*path, known, now);
  const std::uint64_t moved_at = world_.moved_at(agent);
  if (known.since == moved_at) return known.state;
  const physics::BodyPose pose = world_.pose(agent);
  const hal::Vec2 place{pose.position.x, pose.position.y};
  // A body that turns on the spot, or is about to fall asleep, keeps its position.
  const bool is_elsewhere =
      known.since == kNever || place != hal::Vec2{known.state.x, known.state.y};
  known.since = moved_at;
  known.state = {.x = place.x,
                 .y = place.y,
                 .theta = pose.heading,
                 .tilt = pose.tilt,
                 .clearance = is_elsewhere ? clearance(place) : known.state.clearance};
  return known.state;
}

double Scene::clearance(hal::Vec2 place) const {
  if (!wall_tree_.is_empty())
    return wall_tree_.nearest(place, [&](std::uint32_t i) { return distance(place, walls_[i]); });
  double metres = std::numeric_limits<double>::infinity();
  for (const physics::Shape& wall : walls_) metres = std::min(metres, distance(place, wall));
  return metres;
}

hal::Vec3 AgentPositions::position(hal::AgentId agent, hal::Time at) const {
  if (const Path* path = paths_.find(agent)) return on(ground_, path->at(at).position);
  return world_.position(agent);
}

hal::Vec3 AgentPositions::velocity(hal::AgentId agent, hal::Time at) const {
  const Path* const path = paths_.find(agent);
  if (path == nullptr) return world_.velocity(agent).linear;
  const PathState state = path->at(at);
  const hal::Vec2& velocity = state.velocity;
  const hal::Vec3 normal = ground_.normal(state.position);
  return {velocity.x, velocity.y, -(normal.x * velocity.x + normal.y * velocity.y) / normal.z};
}

std::array<double, 4> AgentPositions::attitude(hal::AgentId agent, hal::Time at) const {
  const Path* const path = paths_.find(agent);
  if (path == nullptr) return world_.pose(agent).quaternion;
  const double half = path->at(at).heading / 2;
  return {hal::math::cos(half), 0, 0, hal::math::sin(half)};
}

hal::Time AgentPositions::valid_until(hal::AgentId agent, hal::Time at) const {
  if (const Path* path = paths_.find(agent)) return path->at(at).valid_until;
  return max_speed_ > 0 ? world_.now() + world_.config().step : hal::Time::max();
}

double AgentPositions::max_speed(hal::AgentId agent) const {
  const Path* const path = paths_.find(agent);
  return path == nullptr ? max_speed_ : path->max_speed();
}

}  // namespace sim::agents
