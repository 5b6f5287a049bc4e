#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/message.h"
#include "hal/types/route.h"
#include "hal/types/time.h"

namespace hal::node::exchange {

/// Cause of an event, in the order in which an agent's events at the same time are delivered.
enum class Cause : std::uint8_t {
  kStart,
  kMessage,
  kTimer,
  kNotice,
  kLink,
  kControl,
  kStop,
};

/// New values of a channel. The receiver keeps the values of channels that did not change.
struct Reading {
  std::uint16_t channel = 0;
  std::vector<double> values;
  /// No values: the device has stopped answering and the values held are too old. On hardware only.
  bool lost = false;
  bool operator==(const Reading&) const = default;
};

// The events, one struct for each cause.

/// The first event of a controller.
struct Start {
  bool operator==(const Start&) const = default;
};

struct MessageArrived {
  Message message;
  bool operator==(const MessageArrived&) const = default;
};

struct TimerDue {
  TimerId timer = 0;
  bool operator==(const TimerDue&) const = default;
};

/// The result of a message.
struct Notice {
  MessageId message = 0;  ///< As its sender numbered it.
  Fate fate = Fate::kHandedOver;
  bool operator==(const Notice&) const = default;
};

/// Only the network changed; no callback is called.
struct LinkChanged {
  bool operator==(const LinkChanged&) const = default;
};

/// A control instant.
struct ControlDue {
  bool operator==(const ControlDue&) const = default;
};

/// The last event of a controller.
struct Stop {
  bool operator==(const Stop&) const = default;
};

/// An event for a controller, with all changes since the previous one.
struct Event {
  /// In the order of Cause.
  using What = std::variant<Start, MessageArrived, TimerDue, Notice, LinkChanged, ControlDue, Stop>;

  AgentId agent;
  Time time{};
  What what;
  std::vector<Reading> readings;      ///< Changes since the agent's previous event.
  std::vector<RouteChange> routes;    ///< Changes since the agent's previous event.
  std::vector<Neighbour> neighbours;  ///< Changed ones, if the controller subscribes.
  std::vector<AgentId> lost_neighbours;

  Cause cause() const { return static_cast<Cause>(what.index()); }
  bool operator==(const Event&) const = default;
};

static_assert(std::variant_size_v<Event::What> == static_cast<std::size_t>(Cause::kStop) + 1);

}  // namespace hal::node::exchange
