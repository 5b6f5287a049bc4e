#pragma once

#include <optional>
#include <vector>

#include "sim/agents/movable_obstacles.h"
#include "sim/agents/simulation_config.h"
#include "sim/core/cell_grid.h"
#include "sim/core/obstacle_loss.h"
#include "sim/physics/world.h"
#include "sim/radio/channel/ports.h"
#include "sim/sensing/line_of_sight.h"

namespace sim::agents {

/// Attenuation by the walls and bodies of the world: a loss per crossing and a loss per metre
/// inside.
class WorldObstacles final : public radio::Obstacles {
 public:
  /// @param world  outlives this object; everything was added to it, walls in the order of
  /// `config`.
  WorldObstacles(const physics::World& world, const SimulationConfig& config);

  hal::Decibels loss(const hal::Vec3& from, const hal::Vec3& to) const override;
  hal::Decibels moving_loss(const End& from, const End& to) const override;
  bool has_movables() const override { return !movables_.empty(); }

 private:
  void follow() const;
  void collect(const hal::Vec3& from, const hal::Vec3& to) const;

  const physics::World& world_;
  sensing::LineOfSight line_of_sight_;
  std::vector<ObstacleLoss> walls_;  ///< By wall.
  ObstacleLoss body_;
  std::vector<hal::AgentId> agents_;
  std::vector<std::uint32_t> index_;  ///< Index in agents_, by address.
  double largest_ = 0;                ///< Largest horizontal radius of a body about its origin [m].
  mutable CellGrid grid_;             ///< Grid of agents_, by origin.
  /// Physics step for which the grid is up to date.
  mutable std::optional<std::uint64_t> followed_;
  mutable std::vector<std::uint32_t> near_;
  MovableObstacles movables_;
};

}  // namespace sim::agents
