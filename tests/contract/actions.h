#pragma once

#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/contract/brain.h"
#include "tests/contract/contract_host.h"

namespace contract {

using namespace std::chrono_literals;
using hal::node::exchange::Action;
using hal::node::exchange::Cause;
using hal::node::exchange::DriveBody;
using hal::node::exchange::DriveWheels;
using hal::node::exchange::Event;
using hal::node::exchange::Invalidate;
using hal::node::exchange::MessageArrived;
using hal::node::exchange::Notice;
using hal::node::exchange::Record;
using hal::node::exchange::Send;
using hal::node::exchange::SetRadio;
using hal::node::exchange::SetState;
using hal::node::exchange::SetTimer;
using hal::node::exchange::TimerDue;

inline const hal::AgentId kNobody{99};
inline constexpr hal::Duration kPatience =
    30s;  // of the wall clock: reached by a failing test only
inline constexpr hal::Duration kPeriod = 20ms, kCommandTimeout = 200ms;

template <class Condition>
[[nodiscard]] bool until(Condition condition, hal::Duration patience = kPatience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!condition() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(2ms);
  return condition();
}

inline Action send(hal::AgentId to, hal::MessageId id, hal::Bytes payload = {1, 2, 3}) {
  return {.what =
              Send{.id = id, .destination = to, .topic = "test", .payload = std::move(payload)}};
}

inline Action drive(double vx) { return {.what = DriveBody{{.vx = vx}}}; }

/// Does something once, in the control cycle of an agent when everybody has a controller: a message
/// to an agent without one is lost.
inline Brain::Rule once(hal::AgentId agent, std::vector<Action> actions) {
  return [agent, actions, started = 0](const Event& event) mutable {
    if (event.cause() == Cause::kStart) ++started;
    if (started < 2 || event.agent != agent || event.cause() != Cause::kControl) {
      return std::vector<Action>{};
    }
    return std::exchange(actions, {});
  };
}

}  // namespace contract
