#pragma once

#include <array>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/core/material.h"
#include "sim/core/wall_crossings.h"

namespace sim::radio {

/// Positions of the stations, in metres, world frame. The radio reads them when it needs them and
/// is not informed of every move.
class Positions {
 public:
  virtual ~Positions() = default;
  virtual hal::Vec3 position(hal::AgentId agent, hal::Time at) const = 0;
  virtual hal::Vec3 velocity(hal::AgentId agent, hal::Time at) const = 0;  ///< m/s
  /// Turns the agent's frame, x ahead and z upwards, into that of the world: a unit quaternion, w,
  /// x, y, z. Asked for only where antennas are not equal in all directions.
  virtual std::array<double, 4> attitude(hal::AgentId /*agent*/, hal::Time /*at*/) const {
    return {1, 0, 0, 0};
  }
  /// The position and attitude at `at` hold at least until this time (exclusive); Time::max(): it
  /// never moves.
  virtual hal::Time valid_until(hal::AgentId agent, hal::Time at) const = 0;
  /// Whether position() also answers for times before now, with what it would have answered then.
  virtual bool remembers(hal::AgentId /*agent*/) const { return false; }
  /// Upper bound of the agent's speed [m/s]; 0: it never moves.
  virtual double max_speed(hal::AgentId agent) const = 0;
};

/// Attenuation by obstacles between antennas.
class Obstacles {
 public:
  virtual ~Obstacles() = default;
  /// Loss by the walls that the segment crosses; 0 dB if there are none.
  virtual hal::Decibels loss(const hal::Vec3& from, const hal::Vec3& to) const = 0;

  /// Antenna of an agent; the agent's own body does not attenuate.
  struct End {
    hal::AgentId agent;
    hal::Vec3 antenna;
  };
  /// Loss by obstacles that may move, evaluated when a frame starts. The default is 0 dB.
  virtual hal::Decibels moving_loss(const End& /*from*/, const End& /*to*/) const { return {}; }
  /// Whether moving_loss() may be above 0 dB although bodies of agents do not attenuate.
  virtual bool has_movables() const { return false; }

  /// Materials of the walls, in the order of WallCrossings::walls. The default has no walls.
  virtual std::vector<Material> materials() const { return {}; }
  /// Walls and ceilings that the segment crosses. Parts of walls of one material that are no
  /// farther apart than `gap` along the segment are one wall.
  virtual void crossings(const hal::Vec3& /*from*/, const hal::Vec3& /*to*/, hal::Metres /*gap*/,
                         WallCrossings& crossed) const {
    crossed = {};
  }
};

}  // namespace sim::radio
