#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <ostream>
#include <string>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

namespace contract {

const hal::AgentId kRobot{1}, kMote{2};  ///< "r0" and "m0", which hear each other.

/// What is to be seen of the agents from outside. Any thread.
class Sight {
 public:
  void on_state(hal::AgentId agent, const std::string& state) {
    const std::lock_guard lock(mutex_);
    states_[agent].push_back(state);
  }
  void on_wheels(bool turn) { wheels_turn_ = turn; }

  std::vector<std::string> states(hal::AgentId agent) const {
    const std::lock_guard lock(mutex_);
    const auto found = states_.find(agent);
    return found == states_.end() ? std::vector<std::string>{} : found->second;
  }
  bool wheels_turn() const { return wheels_turn_; }

 private:
  mutable std::mutex mutex_;
  std::map<hal::AgentId, std::vector<std::string>> states_;
  std::atomic<bool> wheels_turn_ = false;
};

/// An implementation of AgentHost that serves the robot and the mote through the gateway, on a
/// thread of its own, until it is destroyed. Their control period is 20 ms, their command timeout
/// 200 ms.
class ContractHost {
 public:
  virtual ~ContractHost() = default;
  virtual int domain() const = 0;
  virtual const Sight& sight() const = 0;
  /// Ends it, if it has not ended. @returns events that found no room while a controller was busy.
  virtual std::uint64_t end() = 0;
};

/// What the hosts promise beyond the common contract.
struct Promises {
  bool waits_for_answers = false;  ///< Lock-step.
  bool takes_successors = false;   ///< Of controllers that died.
  bool has_neighbours = false;     ///< Several servers share the domain.
};

struct Implementation {
  std::string name;
  Promises promises;
  std::function<std::unique_ptr<ContractHost>()> make;
};

Implementation simulator_in_lock_step();
Implementation simulator_in_real_time();
/// For the messages of failing tests.
inline void PrintTo(const Implementation& implementation, std::ostream* out) {
  *out << implementation.name;
}

/// Two agent daemons in one domain, on two addresses of the loopback interface.
/// @param control_period  of both, instead of 20 ms.
Implementation two_daemons(hal::Duration control_period = std::chrono::milliseconds{20});

}  // namespace contract
