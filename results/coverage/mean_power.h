#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/agents/simulation_config.h"
#include "sim/agents/world_obstacles.h"
#include "sim/radio/channel/antenna.h"
#include "sim/radio/channel/propagation.h"

namespace results::coverage {

/// Mean powers in the world of a scenario at its start: the law of distance of its radio, its
/// walls, and the antennas' gains; receivers are equal in all directions. Without shadowing,
/// fading, bodies and interference.
class MeanPower {
 public:
  /// @throws std::runtime_error  the radio has no power levels (disk, ideal), or only those of
  /// measured links.
  explicit MeanPower(const sim::agents::SimulationConfig& config);
  ~MeanPower();

  const sim::radio::WavesConfig& waves() const { return *waves_of(config_.radio); }
  const sim::Ground& ground() const { return *config_.world.ground; }

  /// What leaves an agent's antenna.
  struct Emission {
    hal::Dbm sent{};    ///< With the gains of both antennas in all directions.
    hal::Vec3 antenna;  ///< At the agent's start, world frame, m.
    std::shared_ptr<const sim::radio::DirectedAntenna> directed{};  ///< Null: equal everywhere.

    /// `sent`, times the gain towards a place.
    hal::Dbm towards(const hal::Vec3& place) const;
  };
  Emission emission_of(const sim::agents::AgentConfig& agent) const;

  /// Its power at an antenna at a place, m, world frame, that is equal in all directions.
  hal::Dbm received(const Emission& emission, const hal::Vec3& place) const;

  const sim::radio::Obstacles& obstacles() const { return *obstacles_; }

 private:
  sim::agents::SimulationConfig config_;
  std::unique_ptr<sim::physics::World> world_;
  std::unique_ptr<sim::agents::WorldObstacles> obstacles_;
  std::unique_ptr<sim::radio::Propagation> propagation_;
};

}  // namespace results::coverage
