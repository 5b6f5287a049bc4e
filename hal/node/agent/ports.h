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

/// When things happen: the agent's clock. A timer for a time in the past runs soon.
using routing::Timers;

/// One hop, and its switch.
class Link : public routing::Link {
 public:
  /// Off: nothing is sent and nothing handed on.
  virtual void set_radio(bool on) = 0;
};

/// What moves the agent. Commands have passed exchange::validate() for the limits of its session;
/// what the motors, or an operator, do not allow is scaled down here, direction kept.
class Drive {
 public:
  virtual ~Drive() = default;

  /// @param body   velocity from now on: m/s, rad/s, body frame.
  /// @param as_of  when the command was known to be right, for who counts its age.
  /// Errors: kNotAvailable (may not move now), kNotConnected (the motors cannot be reached).
  virtual Result<void> drive(const Twist2& body, Time as_of) = 0;
  /// @param speeds  rad/s of each wheel. Errors: likewise.
  virtual Result<void> drive_wheels(std::span<const double> speeds, Time as_of) = 0;

  /// Velocity zero, at once. The next command is welcome.
  virtual void halt() = 0;
};

/// What the agent senses: one part per channel of its session, in the order of the session.
class Sensors {
 public:
  virtual ~Sensors() = default;

  /// A control instant has come: reads what has to be read whether or not anybody asks (odometry
  /// adds up), and what several channels share. Once per instant, before sample().
  virtual void advance(Time at) { (void)at; }

  /// Gives the values of a channel as of that instant, in the channel's unit and frame.
  /// @param channel  index into AgentSession::channels.   @param values  empty; filled.
  /// @return false: there are none, the device is silent.
  virtual bool sample(std::size_t channel, Time at, std::vector<double>& values) = 0;
};

/// Told when an agent has something for its controller, or its controller something for the host.
class AgentListener {
 public:
  virtual ~AgentListener() = default;
  /// Events wait: AgentCore::take_events(). Called for each of them, in the middle of the core's
  /// work: to be noted, and done later.
  virtual void on_inbox(AgentId agent) = 0;
  virtual void on_state(AgentId agent, const std::string& state) = 0;
};

}  // namespace hal::node::agent
