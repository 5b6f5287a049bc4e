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
  /// The controller dies, as in a crash: its wheels stop after the command timeout; radio and
  /// routing continue.
  kKill,
  kRestart,    ///< A new controller begins with START; a running one is killed.
  kSwitchOff,  ///< Radio and motors have no power. The controller is not informed.
  kSwitchOn,   ///< Radio and motors have power again.
  kAdd,        ///< An absent agent appears at its pose, switched on, with a new controller.
  kRemove,     ///< The agent is absent: no body, no radio, no controller.
};
std::string_view name(Fortune fortune);  ///< As in scenario files: "switch_off".

struct Befall {
  Fortune fortune = Fortune::kKill;
};

/// From the next physics step on, the body is at this pose, at rest and upright.
struct MoveTo {
  hal::Pose2 pose;  ///< World frame.
};

/// Values that may change during a run; those not set stay as they are.
struct Retune {
  std::optional<hal::Milliwatts> tx_power;  ///< Power into the antenna, > 0.
  std::optional<double> wheel_speed;  ///< Speed limit of every wheel from now on [rad/s], > 0.
};

/// Takes charge from the first battery.
struct Drain {
  std::optional<double> energy;  ///< Energy to take [J], > 0.
  std::optional<double> level;   ///< Instead: remaining state of charge, 0 .. 1.
};

/// An interferer: energy in bursts, which is not a frame.
struct Jam {
  /// Position of its antenna [m]: x, y in the world frame, z above the ground.
  hal::Vec3 position;
  hal::Milliwatts power;
  std::optional<std::uint32_t> channel;  ///< nullopt: that of the scenario's radio.
  hal::Duration duration{};              ///< Duration of the jamming, > 0.
  hal::Duration period{};  ///< From the start of one burst to the start of the next, > 0.
  double duty_cycle = 1;   ///< Share of the period that a burst lasts, > 0 .. 1.
};

struct ScriptedAction {
  std::variant<Befall, MoveTo, Retune, Drain, Jam> what;
  std::string whose;                 ///< Name or pattern, for messages; empty: no agent.
  std::vector<hal::AgentId> agents;  ///< By address; empty: no agent.
  std::string place;                 ///< "file:line:column".
};
/// As in scenario files: "move", "set", "drain", "jam", …
std::string_view name(const ScriptedAction& action);

struct AtTime {
  hal::Duration at{};
};
struct Periodically {
  hal::Duration every{};               ///< > 0
  hal::Duration from{};                ///< The first time.
  std::optional<hal::Duration> until;  ///< Latest time.
  std::optional<std::int64_t> count;   ///< Largest number of times, > 0.
};
/// When the condition begins to hold: each time, or only the first time.
struct Whenever {
  Condition condition;
  bool each_time = false;
};

/// One entry of `events:`: actions on the world that no agent in it causes.
struct ScriptedEvent {
  std::variant<AtTime, Periodically, Whenever> when;
  std::vector<ScriptedAction> actions;  ///< In this order, at the same time.
  std::string place;                    ///< "file:line:column".
};

/// Reports a performed action, for the record.
struct ScriptedDone {
  hal::Time at{};
  std::size_t event = 0;  ///< Index in the scenario.
  std::string_view action;
  hal::AgentId agent{};  ///< 0: none.
};

}  // namespace sim::agents
