#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "controllers/help_message.h"
#include "tests/unit/gateway/runtime/one_agent.h"

namespace tests {

/// A robot that goes to motes that call, in a ControllerHost, with what it senses.
class RobotBench {
 public:
  using Said = std::vector<std::pair<int, controllers::HelpWord>>;

  explicit RobotBench(std::vector<hal::node::exchange::ParameterText> parameters = {},
                      std::vector<hal::node::exchange::AgentName> directory = {}) {
    auto session = robot_session();
    session.parameters = std::move(parameters);
    agent = std::make_unique<OneAgent>(*baraka_controller(), session, std::move(directory));
  }

  Actions hear(int from, controllers::HelpWord word) {
    const auto bytes = controllers::encode(controllers::HelpMessage{.word = word});
    return agent->hear(hal::AgentId{static_cast<std::uint16_t>(from)}, "help",
                       {bytes.begin(), bytes.end()});
  }

  /// Tells the robot that `next_hop` leads to `destination` in so many hops.
  void learn(int destination, int next_hop, int hops, bool removed = false) {
    learn(destination, next_hop, {.hops = static_cast<std::uint16_t>(hops)}, removed);
  }
  void learn(int destination, int next_hop, const hal::PathStatistics& path, bool removed = false) {
    auto event = agent->event(hal::node::exchange::LinkChanged{});
    hal::RouteChange change;
    change.route.topic = "help";
    change.route.destination = hal::AgentId{static_cast<std::uint16_t>(destination)};
    change.route.next_hop = hal::AgentId{static_cast<std::uint16_t>(next_hop)};
    change.route.path = path;
    change.removed = removed;
    event.routes.push_back(change);
    agent->feed(event);
  }

  /// One control cycle later, with everything sensed.
  Actions control() {
    agent->now += std::chrono::milliseconds{100};
    auto event = agent->event(hal::node::exchange::ControlDue{});
    event.readings.push_back({.channel = 0, .values = ranges});
    hal::node::exchange::Reading localisation{.channel = 1, .values = {}};
    for (const auto& [id, at] : positions) {
      localisation.values.insert(localisation.values.end(), {double(id), at.x, at.y});
    }
    event.readings.push_back(localisation);
    return agent->feed(event);
  }

  Actions run_until(hal::Duration until) {
    Actions all;
    while (agent->now < hal::Time{until}) {
      for (auto& action : control()) all.push_back(std::move(action));
    }
    return all;
  }

  static Said said(const Actions& actions) {
    Said words;
    for (const auto& message : all<hal::node::exchange::Send>(actions)) {
      words.emplace_back(message.destination.value,
                         controllers::decode(message.payload).value().word);
    }
    return words;
  }

  std::unique_ptr<OneAgent> agent;
  std::vector<double> ranges = std::vector<double>(6, std::numeric_limits<double>::quiet_NaN());
  std::map<int, hal::Vec2> positions;  ///< Of other agents, body frame.
};

}  // namespace tests
