#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/node/exchange/session.h"
#include "hal/node/exchange/step.h"
#include "hal/types/result.h"

namespace hal::node::exchange {

/// Connects a host to the controllers of some of its agents, in this process or at the other end of
/// a DDS topic pair. At most one Step is under way per port. begin() and finish() are separate so
/// that a host can hand Steps to several ports before it waits for any of them.
class ControllerPort {
 public:
  virtual ~ControllerPort() = default;

  /// Process name, for messages.
  virtual const std::string& name() const = 0;

  /// Hands over a Step. @pre no Step is under way. Errors: kNotConnected.
  virtual Result<void> begin(const Step& step) = 0;

  /// Waits for the Reply to the Step of begin(). Each action in it answers an event of that Step
  /// and has the agent of that event: a port to another process drops others. Actions may still be
  /// invalid (validate.h).
  /// Errors: kNotConnected (the process died), kTimeout (no answer within the reply timeout).
  virtual Result<Reply> finish() = 0;

  /// The same without waiting: nullopt while the process is working on the Step. The caller decides
  /// how long that may take. Errors: kNotConnected (the process died). The default is for ports
  /// whose answer is complete when begin() returns.
  virtual Result<std::optional<Reply>> try_finish() { return finish(); }

  /// Whether simulated time passes while the process waits for something else than a Step, so that
  /// the answer may come at a later simulated time. finish() is not called then, but try_finish()
  /// after each instant.
  virtual bool shares_time() const { return false; }

  /// For poll(): one is readable when try_finish() or check_alive() may have a result. Skip -1.
  /// Empty if the answer is complete when begin() returns.
  virtual std::vector<int> descriptors() const { return {}; }

  /// Whether the process still lives, without waiting. Errors: kNotConnected.
  virtual Result<void> check_alive() = 0;
};

/// An agent that a host offers, before any controller has requested it.
struct AgentOffer {
  AgentSession session;  ///< With every channel the agent has.
  std::string program;   ///< Controller that the scenario names for it; empty: any.
};

/// What a gateway serves: a simulator, or a real robot or mote.
class AgentHost {
 public:
  virtual ~AgentHost() = default;

  /// The agents that need a controller, by address.
  virtual std::vector<AgentOffer> offers() const = 0;

  /// Every agent of the network that the host knows by name, also those that need no controller.
  virtual std::vector<AgentName> directory() const = 0;

  /// Connects a controller process to its agents. Each agent has at most one. A lock-step host
  /// accepts no process after its start; a robot accepts one at any time and begins again with
  /// START.
  virtual void connect(std::shared_ptr<ControllerPort> port, const std::vector<AgentId>& agents,
                       const Wants& wants) = 0;

  /// The controller of these agents is gone. Called for hosts that accept new controllers; others
  /// notice in their exchanges.
  virtual void disconnect(const std::vector<AgentId>& agents) { (void)agents; }
};

/// The session that a process gets for one agent: the offer, reduced to the channels it subscribes
/// to. Errors: kNotAvailable naming a required channel that does not exist.
Result<AgentSession> session_for(const AgentOffer& offer, const Wants& wants);

}  // namespace hal::node::exchange
