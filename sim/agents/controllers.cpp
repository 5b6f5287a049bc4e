#include "sim/agents/controllers.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "hal/types/check.h"
#include "hal/types/log.h"

namespace sim::agents {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

}  // namespace

void Controllers::connect(std::shared_ptr<hal::node::exchange::ControllerPort> port,
                          const std::vector<hal::AgentId>& agents) {
  for (const hal::AgentId agent : agents) {
    BARAKA_CHECK(!is_connected(agent));
    if (agent.value >= port_of_.size()) port_of_.resize(agent.value + 1u, kNone);
    port_of_[agent.value] = ports_.size();
  }
  Connection& connection = ports_.emplace_back();
  connection.port = std::move(port);
  connection.agents = agents;
  if (!connection.port->shares_time()) return;
  connection.courier.emplace(connection.port);
  share_time_ = true;
}

bool Controllers::is_connected(hal::AgentId agent) const {
  return agent.value < port_of_.size() && port_of_[agent.value] != kNone;
}

const std::string& Controllers::process_of(hal::AgentId agent) const {
  BARAKA_CHECK(is_connected(agent));
  return port_name(port_of_[agent.value]);
}

Controllers::Round Controllers::exchange(std::vector<hal::node::exchange::Event>& events,
                                         hal::Time until) {
  distribute(events);
  Round round;
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    Connection& connection = ports_[i];
    if (connection.step.events.empty()) continue;
    connection.step.sequence = ++connection.sequence;
    connection.step.until = until;
    if (auto begun = connection.port->begin(connection.step)) {
      waiting.push_back(i);
    } else {
      round.failures.push_back({i, begun.error()});
    }
  }
  if (share_time_) {
    for (std::size_t i = 0; i < ports_.size(); ++i) attend(i, round);
  }
  for (const std::size_t i : waiting) {
    auto reply = ports_[i].port->finish();
    if (reply) {
      ++exchanges_;
      log_exchange(ports_[i], *reply);
      sort_out(ports_[i], std::move(*reply), round);
    } else {
      round.failures.push_back({i, reply.error()});
    }
  }
  for (Connection& connection : ports_) connection.step.events.clear();
  const auto before = [](const auto& a, const auto& b) { return a.action.agent < b.action.agent; };
  if (!std::is_sorted(round.answers.begin(), round.answers.end(), before))
    std::stable_sort(round.answers.begin(), round.answers.end(), before);
  return round;
}

void Controllers::distribute(std::vector<hal::node::exchange::Event>& events) {
  const bool is_one = ports_.size() == 1 && !ports_.front().dropped && !share_time_;
  if (is_one) {
    ports_.front().step.events.swap(events);  // and keeps the memory of the empty vector
    return;
  }
  for (hal::node::exchange::Event& event : events) {
    Connection& connection = ports_[port_of_[event.agent.value]];
    if (connection.dropped) continue;
    if (connection.courier) {
      connection.courier->post(std::move(event));
    } else {
      connection.step.events.push_back(std::move(event));
    }
  }
  events.clear();
}

/// Until it waits: an answer lets the next events go.
void Controllers::attend(std::size_t port, Round& round) {
  Connection& connection = ports_[port];
  if (connection.dropped || !connection.courier) return;
  auto& courier = *connection.courier;
  for (bool goes_on = true; goes_on && (!courier.is_idle() || courier.has_waiting());) {
    auto turn = courier.attend();
    if (!turn) {
      round.failures.push_back({port, turn.error()});
      return;
    }
    exchanges_ += turn->replied ? 1 : 0;
    for (auto& answer : turn->answers) {
      round.answers.push_back({std::move(answer.action), answer.event_time});
    }
    goes_on = turn->replied || turn->began;
  }
}

bool Controllers::is_one_awaited() const {
  return share_time_ && std::ranges::any_of(ports_, [](const Connection& one) {
           return one.courier && !one.dropped && !one.courier->is_idle();
         });
}

std::vector<std::string> Controllers::complaints() const {
  std::vector<std::string> lines;
  for (const Connection& one : ports_) {
    if (!one.courier || one.dropped) continue;
    const std::string& name = one.port->name();
    if (!one.courier->is_idle()) {
      lines.push_back(
          fmt::format("at the stop: process '{}' waits for simulated time, which is over", name));
    }
    const std::uint64_t missed = one.courier->losses().missed_cycles;
    if (missed == 0) continue;
    lines.push_back(fmt::format("process '{}' waited in its callbacks; control cycles missed: {}",
                                name, missed));
  }
  return lines;
}

void Controllers::log_exchange(const Connection& connection,
                               const hal::node::exchange::Reply& reply) {
  const hal::node::exchange::Step& step = connection.step;
  hal::log::debug(step.events.front().time, "exchange",
                  "Step {} to {}: {} events until {:.9f} s, answered with {} actions",
                  step.sequence, connection.port->name(), step.events.size(),
                  hal::to_seconds(step.until), reply.actions.size());
}

void Controllers::sort_out(Connection& connection, hal::node::exchange::Reply reply, Round& round) {
  const auto& events = connection.step.events;
  for (hal::node::exchange::Action& action : reply.actions) {
    BARAKA_CHECK(action.event < events.size());  // guaranteed by the port
    const hal::Time event_time = events[action.event].time;
    round.answers.push_back({std::move(action), event_time});
  }
}

void Controllers::drop(std::size_t port) { ports_[port].dropped = true; }

std::vector<Controllers::Failure> Controllers::find_dead() {
  std::vector<Failure> dead;
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    if (ports_[i].dropped) continue;
    if (auto alive = ports_[i].port->check_alive(); !alive) dead.push_back({i, alive.error()});
  }
  return dead;
}

}  // namespace sim::agents
