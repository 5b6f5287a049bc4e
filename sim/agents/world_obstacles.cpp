#include "sim/agents/world_obstacles.h"

#include <algorithm>
#include <cmath>

namespace sim::agents {
namespace {

constexpr double kCell = 2;  // m; bodies are smaller and links longer

double decibels(const ObstacleLoss& loss, double metres) {
  return metres > 0 ? loss.per_crossing.value + loss.per_metre * metres : 0;
}

/// Horizontal distance from a point to the farthest point of a shape [m].
double farthest(const hal::Vec3& from, const physics::Shape& shape) {
  const hal::Vec2 way = shape.centre - hal::Vec2{from.x, from.y};
  return std::sqrt(hal::dot(way, way)) +
         std::max(shape.radius, std::sqrt(hal::dot(shape.half, shape.half)));
}

/// Length of the path inside a body; shapes of a body may overlap or stand one above the other.
double length_inside(const physics::World& world, hal::AgentId agent, const hal::Vec3& from,
                     const hal::Vec3& to) {
  double metres = 0;
  for (const physics::Shape& shape : world.shapes_of(agent))
    metres += sensing::length_inside(shape, from, to);
  return metres;
}

}  // namespace

WorldObstacles::WorldObstacles(const physics::World& world, const SimulationConfig& config)
    : world_(world), line_of_sight_(world), grid_(kCell), movables_(world, config.movables) {
  for (const physics::StaticBox& wall : config.walls) walls_.push_back(wall.radio_loss);
  const radio::WavesConfig* const waves = radio::waves_of(config.radio);
  if (waves != nullptr) body_ = waves->propagation.body_loss;
  if (body_.is_none()) return;
  for (const AgentConfig& agent : config.agents) {
    if (!world.has(agent.id)) continue;
    if (agent.id.value >= index_.size()) index_.resize(agent.id.value + 1u, 0);
    index_[agent.id.value] = static_cast<std::uint32_t>(agents_.size());
    agents_.push_back(agent.id);
    for (const physics::Shape& shape : world.shapes_of(agent.id))
      largest_ = std::max(largest_, farthest(world.position(agent.id), shape));
  }
}

hal::Decibels WorldObstacles::loss(const hal::Vec3& from, const hal::Vec3& to) const {
  double sum = 0;
  for (const auto& wall : line_of_sight_.walls_between(from, to))
    sum += decibels(walls_[wall.index], wall.thickness);
  return hal::Decibels{sum};
}

hal::Decibels WorldObstacles::moving_loss(const End& from, const End& to) const {
  double sum = movables_.loss(from.antenna, to.antenna);
  if (body_.is_none()) return hal::Decibels{sum};
  if (followed_ != world_.steps()) follow();
  collect(from.antenna, to.antenna);
  for (const std::uint32_t i : near_) {
    if (agents_[i] == from.agent || agents_[i] == to.agent) continue;
    sum += decibels(body_, length_inside(world_, agents_[i], from.antenna, to.antenna));
  }
  return hal::Decibels{sum};
}

/// Updates the grid: if one step has passed, only bodies that it moved.
void WorldObstacles::follow() const {
  const auto put = [this](std::uint32_t i) {
    const hal::Vec3 p = world_.position(agents_[i]);
    grid_.put(i, {p.x, p.y});
  };
  if (followed_ && *followed_ + 1 == world_.steps()) {
    for (const hal::AgentId agent : world_.moved()) put(index_[agent.value]);
  } else {
    for (std::uint32_t i = 0; i < agents_.size(); ++i) put(i);
  }
  followed_ = world_.steps();
}

/// Bodies that may be on the path, each once: those near one of the segments into which it is
/// divided.
void WorldObstacles::collect(const hal::Vec3& from, const hal::Vec3& to) const {
  near_.clear();
  const hal::Vec3 way = to - from;
  const double pieces = std::ceil(std::max(std::abs(way.x), std::abs(way.y)) / kCell);
  for (double k = 0; k < std::max(pieces, 1.0); ++k) {
    const hal::Vec3 a = from + (k / std::max(pieces, 1.0)) * way;
    const hal::Vec3 b = from + ((k + 1) / std::max(pieces, 1.0)) * way;
    grid_.within({std::min(a.x, b.x) - largest_, std::min(a.y, b.y) - largest_},
                 {std::max(a.x, b.x) + largest_, std::max(a.y, b.y) + largest_}, near_);
  }
  std::ranges::sort(near_);
  near_.erase(std::unique(near_.begin(), near_.end()), near_.end());
}

}  // namespace sim::agents
