#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/node/exchange/session.h"
#include "hal/node/exchange/step.h"
#include "hal/types/result.h"

namespace hal::node::exchange {

/// Where a host finds the controllers of some of its agents: in this process, or at the other end
/// of a DDS topic pair. At most one Step is under way per port. The two halves let a host hand
/// Steps to several ports before it waits for any of them.
class ControllerPort {
 public:
  virtual ~ControllerPort() = default;

  /// For people, in messages: the process name.
  virtual const std::string& name() const = 0;

  /// Hands over a Step. @pre no Step is under way. Errors: kNotConnected.
  virtual Result<void> begin(const Step& step) = 0;

  /// Waits for the Reply to the Step of begin(). Each action in it answers an event of that Step
  /// and is of that event's agent: a port to another process drops others. What the actions ask for
  /// may be against the rules (validate.h).
  /// Errors: kNotConnected (the process died), kTimeout (no answer within the reply timeout).
  virtual Result<Reply> finish() = 0;

  /// The same without waiting: empty while the process still works on the Step. How long that may
  /// take is up to the caller. Errors: kNotConnected (the process died). By default the answer is
  /// there as soon as begin() returns.
  virtual Result<std::optional<Reply>> try_finish() { return finish(); }

  /// For poll(): one is readable when try_finish() or check_alive() may have something new. -1 is
  /// to be skipped. Empty if begin() has the answer.
  virtual std::vector<int> descriptors() const { return {}; }

  /// Whether the process still lives, without waiting. Errors: kNotConnected.
  virtual Result<void> check_alive() = 0;
};

/// One agent that a host offers, before any controller has asked for it.
struct AgentOffer {
  AgentSession session;  ///< With every channel the agent has.
  std::string program;   ///< Controller the scenario names for it; empty: any.
};

/// What a gateway serves: a simulator, or a real robot or mote.
class AgentHost {
 public:
  virtual ~AgentHost() = default;

  /// The agents that need a controller, by address.
  virtual std::vector<AgentOffer> offers() const = 0;

  /// Every agent of the network that the host knows by name, also those that need no controller.
  virtual std::vector<AgentName> directory() const = 0;

  /// Connects a controller process to its agents. Each agent has at most one. A host of lock-step
  /// takes none once it has started; one of a robot does, at any time, and begins anew with START.
  virtual void connect(std::shared_ptr<ControllerPort> port, const std::vector<AgentId>& agents,
                       const Wants& wants) = 0;

  /// The controller of these agents is gone. Told to hosts that take new ones; others learn of it
  /// by their exchanges.
  virtual void disconnect(const std::vector<AgentId>& agents) { (void)agents; }
};

/// The session a process gets for one agent: the offer, reduced to the channels it asked for.
/// Errors: kNotAvailable naming a channel that was asked for and does not exist.
Result<AgentSession> session_for(const AgentOffer& offer, const Wants& wants);

}  // namespace hal::node::exchange
