#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/agents/simulation_config.h"
#include "sim/agents/world_obstacles.h"
#include "sim/radio/channel/propagation.h"

namespace results::coverage {

/// Mean powers in the world of a scenario at its start: the law of distance of its radio, its
/// walls, and the antennas' gains. Without shadowing, fading, bodies and interference.
class MeanPower {
 public:
  /// @throws std::runtime_error  the radio has no power levels (disk, ideal).
  explicit MeanPower(const sim::agents::SimulationConfig& config);
  ~MeanPower();

  const sim::radio::WavesConfig& waves() const { return *waves_of(config_.radio); }
  const sim::Ground& ground() const { return *config_.world.ground; }

  /// What leaves an agent's antenna, with both antennas' gains.
  hal::Dbm sent_by(const sim::agents::AgentConfig& agent) const;
  /// Antenna of an agent at its start, world frame, m.
  hal::Vec3 antenna_of(const sim::agents::AgentConfig& agent) const;

  /// Received power of what is sent with `sent`, from antenna to antenna, m, world frame.
  hal::Dbm received(hal::Dbm sent, const hal::Vec3& from, const hal::Vec3& to) const;

  const sim::radio::Obstacles& obstacles() const { return *obstacles_; }

 private:
  sim::agents::SimulationConfig config_;
  std::unique_ptr<sim::physics::World> world_;
  std::unique_ptr<sim::agents::WorldObstacles> obstacles_;
  std::unique_ptr<sim::radio::Propagation> propagation_;
};

}  // namespace results::coverage
