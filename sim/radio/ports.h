#pragma once

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "hal/types/quantity.h"
#include "hal/types/time.h"

namespace sim::radio {

/// Where the stations are. The radio pulls positions when it needs them; nobody tells it of every
/// move. World frame, metres.
class Positions {
 public:
  virtual ~Positions() = default;
  virtual hal::Vec3 position(hal::AgentId agent, hal::Time at) const = 0;
  virtual hal::Vec3 velocity(hal::AgentId agent, hal::Time at) const = 0;  ///< m/s
  /// The position at `at` holds at least until this time (exclusive); Time::max(): it never moves.
  virtual hal::Time valid_until(hal::AgentId agent, hal::Time at) const = 0;
  /// No agent is ever faster than this; 0: nothing moves. m/s
  virtual double max_speed(hal::AgentId agent) const = 0;
};

/// What stands between antennas.
class Obstacles {
 public:
  virtual ~Obstacles() = default;
  /// Loss of the walls that the segment crosses; 0 dB: free.
  virtual hal::Decibels loss(const hal::Vec3& from, const hal::Vec3& to) const = 0;

  /// Antenna of an agent, whose own body is not in its way.
  struct End {
    hal::AgentId agent;
    hal::Vec3 antenna;
  };
  /// The same of what may move. Asked when a frame starts. @return 0 dB by default.
  virtual hal::Decibels moving_loss(const End& /*from*/, const End& /*to*/) const { return {}; }
};

}  // namespace sim::radio
