#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "sim/agents/observer.h"
#include "sim/agents/paths.h"
#include "sim/agents/simulation_config.h"
#include "sim/core/cell_grid.h"
#include "sim/core/event_queue.h"
#include "sim/core/ground.h"
#include "sim/physics/wall_tree.h"
#include "sim/physics/world.h"
#include "sim/radio/channel/ports.h"
#include "sim/sensing/proximity.h"
#include "sim/sensing/relative_localisation.h"

namespace sim::agents {

/// The world as sensors see it: updated once per physics step, and only when a sensor reads it.
class Scene {
 public:
  /// @param world  outlives this object; all walls and bodies have been added to it.
  /// @param paths  of the agents without bodies; outlives this object. Null: all agents have
  /// bodies.
  Scene(const physics::World& world, const std::vector<hal::AgentId>& agents,
        const Paths* paths = nullptr);

  const physics::World& world() const { return world_; }
  const sensing::Proximity& proximity();

  /// Agents that may be within `range` of a point, and some more, in the order of the
  /// configuration. Valid until the next call. @param range  [m], the same in all calls.
  std::span<const sensing::AgentPosition> near(hal::Vec2 point, double range, hal::Time now);

  /// State of a body, with the distance to the nearest wall's surface (0 inside a wall). Computed
  /// only if the body may have moved since the last call. @param now  not before that of earlier
  /// calls; matters for agents without bodies.
  const BodyState& body(hal::AgentId agent, hal::Time now);

 private:
  struct Known {
    BodyState state;
    std::uint64_t since = kNever;  ///< Last physics step that had moved the body at that time.
  };
  static constexpr std::uint64_t kNever = ~std::uint64_t{0};

  double clearance(hal::Vec2 place) const;
  const BodyState& place(const Path& path, Known& known, hal::Time now) const;
  void follow(double range);
  void follow_paths(hal::Time now);

  const physics::World& world_;
  std::vector<physics::Shape> walls_;
  physics::WallTree wall_tree_;  ///< Of the walls, if they are many.
  std::vector<Known> known_;     ///< By address.
  sensing::Proximity proximity_;
  std::vector<sensing::AgentPosition> positions_;
  const Paths* paths_;
  std::vector<std::uint32_t> index_;   ///< Index in positions_, by address.
  std::vector<std::uint32_t> moving_;  ///< Indices in positions_ of agents on paths.
  std::optional<CellGrid> grid_;       ///< Grid of positions_.
  std::vector<std::uint32_t> found_;
  std::vector<sensing::AgentPosition> near_;
  /// Physics steps of the last updates.
  std::optional<std::uint64_t> proximity_at_, positions_at_;
  hal::Time paths_at_{};
};

/// Positions of agents: the origin of every body after the last physics step; for agents without
/// bodies, the position on their path, on the ground. Antennas are above these positions.
class AgentPositions final : public radio::Positions {
 public:
  /// @param max_speed  of bodies [m/s].
  AgentPositions(const physics::World& world, const Paths& paths, double max_speed)
      : world_(world), ground_(*world.config().ground), paths_(paths), max_speed_(max_speed) {}

  hal::Vec3 position(hal::AgentId agent, hal::Time at) const override;
  hal::Vec3 velocity(hal::AgentId agent, hal::Time at) const override;
  /// Of a path, upright with its heading.
  std::array<double, 4> attitude(hal::AgentId agent, hal::Time at) const override;
  hal::Time valid_until(hal::AgentId agent, hal::Time at) const override;
  /// A path does, a body does not.
  bool remembers(hal::AgentId agent) const override { return paths_.find(agent) != nullptr; }
  double max_speed(hal::AgentId agent) const override;

 private:
  const physics::World& world_;
  const Ground& ground_;
  const Paths& paths_;
  double max_speed_;  ///< [m/s]; also for bodies that are pushed.
};

}  // namespace sim::agents
