#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hal/node/routing/ports.h"
#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "hal/types/result.h"
#include "hal/types/time.h"

namespace hal::node::agent {

/// The agent's clock and timers. A timer set for a time in the past fires soon.
using routing::Timers;

/// Sends to neighbours over one hop, and can be switched off.
class Link : public routing::Link {
 public:
  /// When off, nothing is sent and no received frame is passed on.
  virtual void set_radio(bool on) = 0;
};

/// Moves the agent. Commands have passed exchange::validate() for the limits of the session; a
/// command beyond what the motors or an operator permit is scaled down here and keeps its
/// direction.
class Drive {
 public:
  virtual ~Drive() = default;

  /// @param body   velocity from now on: m/s, rad/s, body frame.
  /// @param as_of  when the command arrived; the command timeout counts from then.
  /// Errors: kNotAvailable (may not move now), kNotConnected (the motors cannot be reached).
  virtual Result<void> drive(const Twist2& body, Time as_of) = 0;
  /// @param speeds  rad/s of each wheel. Errors: as drive().
  virtual Result<void> drive_wheels(std::span<const double> speeds, Time as_of) = 0;

  /// Sets the velocity to zero at once. Later commands are accepted.
  virtual void halt() = 0;
};

/// The sensors of the agent: one part per channel of its session, in the order of the session.
class Sensors {
 public:
  virtual ~Sensors() = default;

  /// Called once per control instant, before sample(): reads what must be read whether or not a
  /// channel is sampled (odometry accumulates), and what several channels share.
  virtual void advance(Time at) { (void)at; }

  /// Gives the values of a channel as of that instant, in the channel's unit and frame.
  /// @param channel  index into AgentSession::channels.   @param values  empty; filled.
  /// @return false if there are no values because the device does not answer.
  virtual bool sample(std::size_t channel, Time at, std::vector<double>& values) = 0;
};

/// Notified when an agent has events for its controller, and when its state changes.
class AgentListener {
 public:
  virtual ~AgentListener() = default;
  /// Events wait in AgentCore::take_events(). Called for each of them while the core is working:
  /// note it and act later.
  virtual void on_inbox(AgentId agent) = 0;
  virtual void on_state(AgentId agent, const std::string& state) = 0;
};

}  // namespace hal::node::agent
