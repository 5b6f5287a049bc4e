#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/node/exchange/courier.h"
#include "hal/node/exchange/ports.h"
#include "hal/types/agent_id.h"

namespace sim::agents {

/// The controller processes of a run, and the exchange of events and actions with them.
class Controllers {
 public:
  struct Answer {
    hal::node::exchange::Action action;
    hal::Time event_time{};  ///< Time of the event that the action answers.
  };
  struct Failure {
    std::size_t port = 0;
    hal::Error error;
  };
  struct Round {
    std::vector<Answer> answers;    ///< By agent; for each agent in the order of its calls.
    std::vector<Failure> failures;  ///< Ports that gave no reply.
  };

  /// Adds a controller process. @pre none of the agents is connected yet.
  void connect(std::shared_ptr<hal::node::exchange::ControllerPort> port,
               const std::vector<hal::AgentId>& agents);

  bool is_connected(hal::AgentId agent) const;
  const std::string& port_name(std::size_t port) const { return ports_[port].port->name(); }
  const std::vector<hal::AgentId>& agents_of(std::size_t port) const { return ports_[port].agents; }
  const std::string& process_of(hal::AgentId agent) const;

  std::size_t ports() const { return ports_.size(); }
  const std::shared_ptr<hal::node::exchange::ControllerPort>& port(std::size_t index) const {
    return ports_[index].port;
  }
  std::size_t port_of(hal::AgentId agent) const { return port_of_[agent.value]; }

  /// Passes the events to the ports of their agents, all at the same time, and waits for all
  /// replies, except those of ports that share the simulated time: of these it takes what is there.
  /// Events for one that has not answered yet wait.
  /// @param events  ordered by (time, agent, cause, arrival); emptied. @param until  no later event
  /// will be before this time.
  Round exchange(std::vector<hal::node::exchange::Event>& events, hal::Time until);
  Round exchange(std::vector<hal::node::exchange::Event>&& events, hal::Time until) {
    return exchange(events, until);
  }

  /// Whether there are ports that share the simulated time.
  bool share_time() const { return share_time_; }
  /// Whether one of these has not answered yet.
  bool is_one_awaited() const;
  /// At the end of the run, for the log: which of these have not, and what they have missed.
  std::vector<std::string> complaints() const;

  /// Removes a port: its agents receive no more events.
  void drop(std::size_t port);

  /// Ports whose processes have ended; does not wait.
  std::vector<Failure> find_dead();

  std::uint64_t exchanges() const { return exchanges_; }  ///< Number of steps answered.

 private:
  struct Connection {
    std::shared_ptr<hal::node::exchange::ControllerPort> port;
    std::vector<hal::AgentId> agents;
    hal::node::exchange::Step step;  ///< In progress, or empty.
    std::uint64_t sequence = 0;
    bool dropped = false;
    std::optional<hal::node::exchange::Courier> courier;  ///< If it shares the simulated time.
  };

  void distribute(std::vector<hal::node::exchange::Event>& events);
  static void log_exchange(const Connection& connection, const hal::node::exchange::Reply& reply);
  void sort_out(Connection& connection, hal::node::exchange::Reply reply, Round& round);
  void attend(std::size_t port, Round& round);

  std::vector<Connection> ports_;
  std::vector<std::size_t> port_of_;  ///< By address; kNone: not connected.
  std::uint64_t exchanges_ = 0;
  bool share_time_ = false;
};

}  // namespace sim::agents
