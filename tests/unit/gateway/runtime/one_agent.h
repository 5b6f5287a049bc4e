#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gateway/runtime/controller_host.h"
#include "hal/types/check.h"
#include "tests/support/exchange.h"

namespace tests {

using Actions = std::vector<hal::node::exchange::Action>;

inline hal::node::exchange::AgentSession mote_session() {
  hal::node::exchange::AgentSession session;
  session.agent = hal::AgentId{17};
  session.name = "m17";
  session.kind = hal::AgentKind::kMote;
  session.seed = 1;
  session.control_period = std::chrono::milliseconds{100};
  return session;
}

/// A robot with three wheels at 60, 180 and 300 degrees, 0.132 m from the middle, radius 0.04 m,
/// limit 23.56 rad/s (docs/models.md, 5); channels infrared (0), localisation (1), odometry (2),
/// battery (3).
inline hal::node::exchange::AgentSession robot_session() {
  hal::node::exchange::AgentSession session = mote_session();
  session.agent = hal::AgentId{26};
  session.name = "r0";
  session.kind = hal::AgentKind::kRobot;
  const double half_root = 0.86602540378443865;
  session.limits.body_to_wheel = {{-half_root / 0.04, 0.5 / 0.04, 0.132 / 0.04},
                                  {0.0, -1.0 / 0.04, 0.132 / 0.04},
                                  {half_root / 0.04, 0.5 / 0.04, 0.132 / 0.04}};
  session.limits.wheel_speed = 23.56;
  const auto add = [&](const char* name, const char* kind, std::uint32_t length) -> hal::Channel& {
    hal::Channel channel;
    channel.id = static_cast<std::uint16_t>(session.channels.size());
    channel.name = name;
    channel.kind = kind;
    channel.length = length;
    return session.channels.emplace_back(std::move(channel));
  };
  const double pi = 3.14159265358979323846;
  add("infrared", "range", 6).headings = {0, pi / 3, 2 * pi / 3, pi, -2 * pi / 3, -pi / 3};
  add("localisation", "relative_position", 0);
  add("odometry", "odometry", 6);
  add("battery", "battery", 5);
  return session;
}

inline hal::node::exchange::Session session_of(hal::node::exchange::AgentSession agent) {
  hal::node::exchange::Session session;
  session.agents.push_back(std::move(agent));
  return session;
}

/// One agent in a ControllerHost, fed one event at a time.
class OneAgent {
 public:
  OneAgent(const hal::ControllerKind& kind, hal::node::exchange::AgentSession agent,
           std::vector<hal::node::exchange::AgentName> directory = {})
      : session_(std::move(agent)) {
    hal::node::exchange::Session session = session_of(session_);
    session.directory = std::move(directory);
    auto host = gateway::runtime::ControllerHost::create(kind, session);
    if (!host) std::fprintf(stderr, "%s\n", host.error().message.c_str());
    BARAKA_CHECK(host.has_value());
    host_ = std::move(*host);
  }

  /// An event of this agent at the present time.
  hal::node::exchange::Event event(hal::node::exchange::Event::What what) const {
    hal::node::exchange::Event event;
    event.agent = session_.agent;
    event.time = now;
    event.what = std::move(what);
    return event;
  }

  Actions feed(hal::node::exchange::Event event) {
    hal::node::exchange::Step step;
    step.sequence = ++sequence_;
    step.events.push_back(std::move(event));
    return host_->answer(step).actions;
  }

  Actions start() { return feed(event(hal::node::exchange::Start{})); }
  Actions control() { return feed(event(hal::node::exchange::ControlDue{})); }

  Actions hear(hal::AgentId from, std::string topic, hal::Bytes payload) {
    return feed(event(hal::node::exchange::MessageArrived{{.source = from,
                                                           .destination = session_.agent,
                                                           .id = ++heard_,
                                                           .topic = std::move(topic),
                                                           .payload = std::move(payload)}}));
  }

  gateway::runtime::ControllerHost& host() { return *host_; }

  hal::Time now{};

 private:
  hal::node::exchange::AgentSession session_;
  std::unique_ptr<gateway::runtime::ControllerHost> host_;
  std::uint64_t sequence_ = 0;
  hal::MessageId heard_ = 0;
};

/// Texts of the actions of one kind: states entered, lines logged, errors.
template <class What>
std::vector<std::string> texts(const Actions& actions) {
  std::vector<std::string> found;
  for (const What& what : all<What>(actions)) found.push_back(text_of(what));
  return found;
}

inline std::vector<std::string> states(const Actions& actions) {
  return texts<hal::node::exchange::SetState>(actions);
}

}  // namespace tests
