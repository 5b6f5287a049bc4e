#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sim/agents/observer.h"
#include "sim/agents/paths.h"
#include "sim/agents/simulation_config.h"
#include "sim/core/cell_grid.h"
#include "sim/core/event_queue.h"
#include "sim/core/ground.h"
#include "sim/physics/world.h"
#include "sim/radio/ports.h"
#include "sim/sensing/proximity.h"
#include "sim/sensing/relative_localisation.h"

namespace sim::agents {

/// The world as sensors see it: brought up to date once per physics step, and only when a sensor
/// looks.
class Scene {
 public:
  /// @param world  outlives this; everything was added to it.
  /// @param paths  of the agents without bodies; outlives this. Null: all have bodies.
  Scene(const physics::World& world, const std::vector<hal::AgentId>& agents,
        const Paths* paths = nullptr);

  const physics::World& world() const { return world_; }
  const sensing::Proximity& proximity();

  /// Agents that may be within `range` of a point, in the order of the configuration, and some
  /// more. Good until the next call. @param range  m, the same in all calls.
  std::span<const sensing::AgentPosition> near(hal::Vec2 point, double range, hal::Time now);

  /// State of a body, with the distance to the nearest wall's surface (0 inside a wall). Costs
  /// something only if the body may have moved since it was asked for. @param now  not before
  /// that of earlier calls; counts for agents without bodies.
  const BodyState& body(hal::AgentId agent, hal::Time now);

 private:
  struct Known {
    BodyState state;
    std::uint64_t since = kNever;  ///< Step that had last moved the body then.
  };
  static constexpr std::uint64_t kNever = ~std::uint64_t{0};

  double clearance(hal::Vec2 place) const;
  const BodyState& place(const Path& path, Known& known, hal::Time now) const;
  void follow(double range);
  void follow_paths(hal::Time now);

  const physics::World& world_;
  std::vector<physics::Shape> walls_;
  std::vector<Known> known_;  ///< By address.
  sensing::Proximity proximity_;
  std::vector<sensing::AgentPosition> positions_;
  const Paths* paths_;
  std::vector<std::uint32_t> index_;   ///< In positions_, by address.
  std::vector<std::uint32_t> moving_;  ///< In positions_: on paths.
  std::optional<CellGrid> grid_;       ///< Of positions_.
  std::vector<std::uint32_t> found_;
  std::vector<sensing::AgentPosition> near_;
  std::optional<std::uint64_t> proximity_at_, positions_at_;  ///< Physics steps.
  hal::Time paths_at_{};
};

/// Where agents are: the origin of every body as of the last physics step; of agents without bodies
/// where their paths are, on the ground. Antennas are above it.
class AgentPositions final : public radio::Positions {
 public:
  /// @param max_speed  of bodies, m/s.
  AgentPositions(const physics::World& world, const Paths& paths, double max_speed)
      : world_(world), ground_(*world.config().ground), paths_(paths), max_speed_(max_speed) {}

  hal::Vec3 position(hal::AgentId agent, hal::Time at) const override;
  hal::Vec3 velocity(hal::AgentId agent, hal::Time at) const override;
  hal::Time valid_until(hal::AgentId agent, hal::Time at) const override;
  double max_speed(hal::AgentId agent) const override;

 private:
  const physics::World& world_;
  const Ground& ground_;
  const Paths& paths_;
  double max_speed_;  ///< m/s; bounds every body, pushed ones included.
};

}  // namespace sim::agents
