#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/agents/condition.h"

namespace sim::agents {

/// Scripted changes of agents.
enum class Fortune : std::uint8_t {
  /// The controller dies, as by a crash: its wheels stop after the command timeout, radio and
  /// routing continue.
  kKill,
  kRestart,    ///< A new controller begins with START; a running one is killed.
  kSwitchOff,  ///< Radio and motors have no power. The controller is not told.
  kSwitchOn,   ///< Radio and motors have power again.
  kAdd,        ///< An absent agent appears at its pose, switched on, with a new controller.
  kRemove,     ///< The agent is absent: no body, no radio, no controller.
};
std::string_view name(Fortune fortune);  ///< As in files: "switch_off".

struct Befall {
  Fortune fortune = Fortune::kKill;
};

/// Its body is somewhere else from the next physics step on, at rest and upright.
struct MoveTo {
  hal::Pose2 pose;  ///< World frame.
};

/// Values that may change while a run goes on; what is not set stays.
struct Retune {
  std::optional<hal::Milliwatts> tx_power;  ///< Into the antenna, > 0.
  std::optional<double> wheel_speed;        ///< rad/s, > 0: no wheel turns faster any more.
};

/// Takes charge out of the first battery.
struct Drain {
  std::optional<double> energy;  ///< J, > 0 …
  std::optional<double> level;   ///< … or down to this share of the capacity, 0 .. 1.
};

/// An interferer: energy that nobody can receive, in bursts.
struct Jam {
  hal::Vec3 position;  ///< m, of its antenna: x and y in the world frame, z above the ground
  hal::Milliwatts power;
  std::optional<std::uint32_t> channel;  ///< None: that of the scenario's radio.
  hal::Duration duration{};              ///< > 0
  hal::Duration period{};                ///< From the start of one burst to that of the next, > 0.
  double duty_cycle = 1;                 ///< Share of the period, > 0 .. 1.
};

struct ScriptedAction {
  std::variant<Befall, MoveTo, Retune, Drain, Jam> what;
  std::string whose;                 ///< Name or pattern, for people; empty: of nobody.
  std::vector<hal::AgentId> agents;  ///< By address; empty: of nobody.
  std::string place;                 ///< "file:line:column".
};
/// As in files: "move", "set", "drain", "jam", …
std::string_view name(const ScriptedAction& action);

struct AtTime {
  hal::Duration at{};
};
struct Periodically {
  hal::Duration every{};               ///< > 0
  hal::Duration from{};                ///< The first time.
  std::optional<hal::Duration> until;  ///< The last one is not after that.
  std::optional<std::int64_t> count;   ///< At most so often, > 0.
};
/// At the instant at which the condition begins to hold; each time that it does, or once.
struct Whenever {
  Condition condition;
  bool each_time = false;
};

/// One entry of `events:`: things that happen to the world and come from nobody in it.
struct ScriptedEvent {
  std::variant<AtTime, Periodically, Whenever> when;
  std::vector<ScriptedAction> actions;  ///< In this order, at one instant.
  std::string place;                    ///< "file:line:column".
};

/// That an action was done, for the record.
struct ScriptedDone {
  hal::Time at{};
  std::size_t event = 0;  ///< Index in the scenario.
  std::string_view action;
  hal::AgentId agent{};  ///< 0: of nobody.
};

}  // namespace sim::agents
