#pragma once

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "hal/types/quantity.h"
#include "hal/types/time.h"

namespace sim::radio {

/// Positions of the stations, in metres, world frame. The radio reads them when it needs them and
/// is not informed of every move.
class Positions {
 public:
  virtual ~Positions() = default;
  virtual hal::Vec3 position(hal::AgentId agent, hal::Time at) const = 0;
  virtual hal::Vec3 velocity(hal::AgentId agent, hal::Time at) const = 0;  ///< m/s
  /// The position at `at` holds at least until this time (exclusive); Time::max(): it never moves.
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
};

}  // namespace sim::radio
