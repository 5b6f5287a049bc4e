#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "hal/types/log.h"
#include "hal/types/message.h"
#include "hal/types/priority.h"
#include "hal/types/time.h"

namespace hal::node::exchange {

// The actions of a controller, one struct for each kind.

struct DriveBody {
  Twist2 twist;  ///< Body frame. m/s, rad/s
  bool operator==(const DriveBody&) const = default;
};

struct DriveWheels {
  std::vector<double> speeds;  ///< One per driven wheel. rad/s
  bool operator==(const DriveWheels&) const = default;
};

struct Send {
  MessageId id = 0;  ///< 1, 2, 3, … per controller.
  AgentId destination;
  std::string topic;
  Bytes payload;
  Priority priority{};
  bool operator==(const Send&) const = default;
};

/// The agent must forget its routes of a topic to a destination.
struct Invalidate {
  AgentId destination;
  std::string topic;
  bool operator==(const Invalidate&) const = default;
};

struct SetTimer {
  TimerId timer = 0;
  Time at{};
  bool operator==(const SetTimer&) const = default;
};

struct SetRadio {
  bool on = true;
  bool operator==(const SetRadio&) const = default;
};

struct SetState {
  std::string name;
  bool operator==(const SetState&) const = default;
};

struct Log {
  log::Level level = log::Level::kInfo;
  std::string text;
  bool operator==(const Log&) const = default;
};

/// The controller threw an exception; no further action of this agent follows.
struct ControllerFailed {
  std::string text;
  bool operator==(const ControllerFailed&) const = default;
};

struct Record {
  std::string name;
  double value = 0;
  Time at{};  ///< Time of the event, when the value was measured.
  bool operator==(const Record&) const = default;
};

/// An action of a controller.
struct Action {
  /// In this order: fingerprints contain the index.
  using What = std::variant<DriveBody, DriveWheels, Send, Invalidate, SetTimer, SetRadio, SetState,
                            Log, ControllerFailed, Record>;

  AgentId agent{};
  std::uint32_t event = 0;  ///< Index into Step::events of the event that caused it.
  What what = Log{};
  bool operator==(const Action&) const = default;
};

inline bool drives(const Action& action) {
  return std::holds_alternative<DriveBody>(action.what) ||
         std::holds_alternative<DriveWheels>(action.what);
}

/// Actions that do not affect the world; they take effect even when the agent is over.
inline bool is_word(const Action& action) {
  return std::holds_alternative<SetState>(action.what) ||
         std::holds_alternative<Log>(action.what) || std::holds_alternative<Record>(action.what);
}

}  // namespace hal::node::exchange
