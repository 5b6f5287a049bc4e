#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal/node/exchange/ports.h"
#include "hal/types/agent_id.h"

namespace sim::agents {

/// The controller processes of a run, and the exchange with them.
class Controllers {
 public:
  struct Answer {
    hal::node::exchange::Action action;
    hal::Time event_time{};  ///< Of the event that the action answers.
  };
  struct Failure {
    std::size_t port = 0;
    hal::Error error;
  };
  struct Round {
    std::vector<Answer> answers;    ///< By agent; an agent's in the order of its calls.
    std::vector<Failure> failures;  ///< Ports that gave no answer.
  };

  /// @pre none of the agents is connected yet.
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

  /// Hands the events to the ports of their agents, to all at once, and waits for all answers.
  /// @param events  by (time, agent, cause, arrival); empty afterwards.  @param until  no later
  /// event is before this.
  Round exchange(std::vector<hal::node::exchange::Event>& events, hal::Time until);
  Round exchange(std::vector<hal::node::exchange::Event>&& events, hal::Time until) {
    return exchange(events, until);
  }

  /// Takes a port out: its agents get no more events.
  void drop(std::size_t port);

  /// Ports whose processes are gone, without waiting.
  std::vector<Failure> find_dead();

  std::uint64_t exchanges() const { return exchanges_; }  ///< Steps answered.

 private:
  struct Connection {
    std::shared_ptr<hal::node::exchange::ControllerPort> port;
    std::vector<hal::AgentId> agents;
    hal::node::exchange::Step step;  ///< Under way, or empty.
    std::uint64_t sequence = 0;
    bool dropped = false;
  };

  void distribute(std::vector<hal::node::exchange::Event>& events);
  static void log_exchange(const Connection& connection, const hal::node::exchange::Reply& reply);
  void sort_out(Connection& connection, hal::node::exchange::Reply reply, Round& round);

  std::vector<Connection> ports_;
  std::vector<std::size_t> port_of_;  ///< By address; kNone: not connected.
  std::uint64_t exchanges_ = 0;
};

}  // namespace sim::agents
