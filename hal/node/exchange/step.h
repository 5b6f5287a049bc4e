#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "hal/types/log.h"
#include "hal/types/message.h"
#include "hal/types/route.h"
#include "hal/types/time.h"

namespace hal::node::exchange {

/// Why an event happens, in the order in which an agent's events of one instant are handed over.
enum class Cause : std::uint8_t {
  kStart,
  kMessage,
  kTimer,
  kNotice,
  kLink,  ///< Only the network changed; no callback.
  kControl,
  kStop,
};

/// New values of a channel. Channels that did not change are held by the receiver.
struct Reading {
  std::uint16_t channel = 0;
  std::vector<double> values;
  /// There are none: the device has fallen silent, what was held is too old. On hardware only.
  bool lost = false;
  bool operator==(const Reading&) const = default;
};

/// Everything a controller can know arrives in one of these.
struct Event {
  AgentId agent;
  Time time{};
  Cause cause = Cause::kStart;
  std::vector<Reading> readings;      ///< Changes since the agent's previous event.
  std::optional<Message> message;     ///< kMessage.
  TimerId timer = 0;                  ///< kTimer.
  MessageId noticed = 0;              ///< kNotice …
  Fate fate = Fate::kHandedOver;      ///< … and what became of it.
  std::vector<RouteChange> routes;    ///< Changes since the agent's previous event.
  std::vector<Neighbour> neighbours;  ///< Changed ones, if the controller asked.
  std::vector<AgentId> lost_neighbours;
  bool operator==(const Event&) const = default;
};

/// Work for one process: all events of one round, or of one lookahead window.
struct Step {
  std::string server;
  std::uint64_t run = 0;
  std::uint64_t sequence = 0;  ///< 1, 2, 3, … per process.
  Time until{};                ///< No later event will be before this time.
  std::vector<Event> events;   ///< By (time, agent, cause, arrival).
  bool operator==(const Step&) const = default;
};

enum class ActionKind : std::uint8_t {
  kDriveBody,    ///< twist
  kDriveWheels,  ///< wheel_speeds
  kSend,         ///< message_id, destination, topic, payload
  kInvalidate,   ///< topic, destination
  kTimer,        ///< timer, at
  kRadio,        ///< radio_on
  kState,        ///< text
  kLog,          ///< level, text
  kError,        ///< text: the controller threw; nothing of this agent follows
  kRecord,       ///< text: the name of the value; value; at: of the event, when it was true
};

/// Everything a controller does leaves in one of these.
struct Action {
  AgentId agent;
  std::uint32_t event = 0;  ///< Index into Step::events of the event it answers.
  ActionKind kind = ActionKind::kLog;
  Twist2 twist;
  std::vector<double> wheel_speeds;
  MessageId message_id = 0;
  AgentId destination;
  std::string topic;
  Bytes payload;
  TimerId timer = 0;
  Time at{};
  bool radio_on = true;
  std::string text;
  double value = 0;
  log::Level level = log::Level::kInfo;
  bool operator==(const Action&) const = default;
};

inline bool drives(const Action& action) {
  return action.kind == ActionKind::kDriveBody || action.kind == ActionKind::kDriveWheels;
}

/// Words change nothing in the world: they count also when the agent is over.
inline bool is_word(const Action& action) {
  return action.kind == ActionKind::kState || action.kind == ActionKind::kLog ||
         action.kind == ActionKind::kRecord;
}

/// The answer to the Step of the same sequence.
struct Reply {
  std::string process;
  std::uint64_t run = 0;
  std::uint64_t sequence = 0;
  std::vector<Action> actions;  ///< In the order of the controllers' calls.
  bool operator==(const Reply&) const = default;
};

}  // namespace hal::node::exchange
