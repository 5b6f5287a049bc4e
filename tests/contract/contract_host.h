#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "hal/node/exchange/ports.h"
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
  /// @param speed  m/s, of the robot.
  void on_speed(double speed) {
    constexpr double kStanding = 5e-4;  // m/s
    speed_ = speed;
    top_speed_ = std::max(top_speed_.load(), speed);
    wheels_turn_ = speed > kStanding;
  }
  void on_record(hal::AgentId agent, const std::string& name, double value) {
    const std::lock_guard lock(mutex_);
    records_[agent].emplace_back(name, value);
  }
  void on_range(hal::AgentId agent) {
    const std::lock_guard lock(mutex_);
    ++ranges_[agent];
  }

  std::vector<std::string> states(hal::AgentId agent) const {
    const std::lock_guard lock(mutex_);
    const auto found = states_.find(agent);
    return found == states_.end() ? std::vector<std::string>{} : found->second;
  }
  std::vector<std::pair<std::string, double>> records(hal::AgentId agent) const {
    const std::lock_guard lock(mutex_);
    const auto found = records_.find(agent);
    return found == records_.end() ? decltype(found->second){} : found->second;
  }
  bool wheels_turn() const { return wheels_turn_; }
  double speed() const { return speed_; }          ///< m/s, as seen last …
  double top_speed() const { return top_speed_; }  ///< … and the greatest so far.
  /// Readings of range sensors that were shown.
  std::size_t ranges(hal::AgentId agent) const {
    const std::lock_guard lock(mutex_);
    const auto found = ranges_.find(agent);
    return found == ranges_.end() ? 0 : found->second;
  }

 private:
  mutable std::mutex mutex_;
  std::map<hal::AgentId, std::vector<std::string>> states_;
  std::map<hal::AgentId, std::vector<std::pair<std::string, double>>> records_;
  std::map<hal::AgentId, std::size_t> ranges_;
  std::atomic<bool> wheels_turn_ = false;
  std::atomic<double> speed_ = 0, top_speed_ = 0;
};

/// What became of a host.
struct End {
  std::uint64_t lost = 0;     ///< Events that found no room while a controller was busy.
  std::uint64_t refused = 0;  ///< Actions against the rules.
};

/// An implementation of AgentHost that has the robot and the mote, on a thread of its own, until it
/// is destroyed. Their control period is 20 ms, their command timeout 200 ms.
class ContractHost {
 public:
  virtual ~ContractHost() = default;
  virtual const Sight& sight() const = 0;
  /// What the robot's motors can do.
  virtual hal::node::exchange::DriveLimits limits() const = 0;
  /// Serves controllers through the gateway in this domain; none: in process, by connect().
  virtual std::optional<int> domain() const = 0;
  /// The controller of an agent, called on the host's thread; outlives the host. @pre no domain
  virtual void connect(std::shared_ptr<hal::node::exchange::ControllerPort> port,
                       hal::AgentId agent, const hal::Wants& wants) = 0;
  /// Whom the host of the agent knows by name. @pre no domain
  virtual std::vector<hal::node::exchange::AgentName> directory(hal::AgentId agent) const = 0;
  /// Ends it, if it has not ended.
  virtual End end() = 0;
};

/// What the hosts promise beyond the common contract.
struct Promises {
  bool waits_for_answers = false;  ///< Lock-step.
  bool takes_successors = false;   ///< Of controllers that died.
  bool has_neighbours = false;     ///< Several servers share the domain.
  bool senses_the_world = false;   ///< Has the sensors that need a world: pose, bumper, scan.
};

struct Implementation {
  std::string name;
  Promises promises;
  std::function<std::unique_ptr<ContractHost>()> make;
};

Implementation simulator_in_lock_step();
Implementation simulator_in_real_time();
/// In lock-step, with controllers in process whose actions take effect 10 ms later.
Implementation simulator_in_process();
/// For the messages of failing tests.
inline void PrintTo(const Implementation& implementation, std::ostream* out) {
  *out << implementation.name;
}

/// Two agent daemons in one domain, on two addresses of the loopback interface.
/// @param control_period  of both, instead of 20 ms.
Implementation two_daemons(hal::Duration control_period = std::chrono::milliseconds{20});
/// The same with controllers in process.
Implementation two_daemons_in_process();

}  // namespace contract
