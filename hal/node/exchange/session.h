#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/channel.h"
#include "hal/types/time.h"
#include "hal/types/wants.h"

namespace hal::node::exchange {

/// Version of the values in this folder as they travel. Two sides of different versions refuse
/// each other.
inline constexpr std::uint32_t kProtocolVersion = 6;

/// A parameter as the scenario gives it, with the place of its value for error messages.
struct ParameterText {
  std::string name;
  std::string value;  ///< With its unit, e.g. "15 s".
  std::string place;  ///< "file:line:column".
  bool is_list = false;
  std::vector<std::string> items{};  ///< Of a list, whose `value` is empty.
  bool operator==(const ParameterText&) const = default;
};

/// What the motors can do. Wheel speeds [rad/s] = rows of `body_to_wheel` times (vx, vy, omega).
struct DriveLimits {
  std::vector<std::array<double, 3>> body_to_wheel;  ///< Of the driven wheels. Empty: none.
  /// (vx, vy, omega) = sum over the wheels of their speed times their row: the feasible motion that
  /// fits the speeds best. Empty: every motion is feasible.
  std::vector<std::array<double, 3>> wheel_to_body;
  double wheel_speed = 0;  ///< rad/s, of every wheel.
  bool operator==(const DriveLimits&) const = default;
};

/// One agent as its controller's process gets to know it.
struct AgentSession {
  AgentId agent;
  std::string name;
  AgentKind kind = AgentKind::kMote;
  std::uint64_t seed = 0;  ///< Of the run; the controller's stream is (seed, "<name>/controller").
  Duration control_period{};
  std::vector<ParameterText> parameters;
  std::vector<Channel> channels;
  DriveLimits limits;
  /// Network interface on which the controller may open sockets of its own; empty: on none.
  std::string air_interface{};
  bool operator==(const AgentSession&) const = default;
};

/// An agent of the network, for who looks for it by name.
struct AgentName {
  AgentId agent;
  std::string name;
  bool operator==(const AgentName&) const = default;
};

/// A process introduces itself.
struct Hello {
  std::uint32_t version = kProtocolVersion;
  std::string process;   ///< For people: --name, default program.pid.
  std::string instance;  ///< Unique per process start.
  std::string program;   ///< Kind of controller it runs.
  std::string host;
  std::int64_t pid = 0;
  std::uint64_t pid_start_time = 0;   ///< Field 22 of /proc/<pid>/stat: tells recycled pids apart.
  std::vector<std::string> patterns;  ///< Names it asks for; `*` and `?` match as in a shell.
  AgentKind kind = AgentKind::kMote;  ///< What it can drive …
  bool both_kinds = false;            ///< … or both.
  Wants wants;
  bool operator==(const Hello&) const = default;
};

/// The answer to a Hello: the granted agents, or a refusal with its reason.
struct Session {
  std::uint32_t version = kProtocolVersion;
  std::string server;
  std::string instance;  ///< Of the Hello this answers.
  std::uint64_t run = 0;
  std::string refusal;  ///< Empty: granted.
  std::vector<AgentSession> agents;
  /// Once per process, however many agents it drives; only if Wants::names asks.
  std::vector<AgentName> directory{};
  bool operator==(const Session&) const = default;
};

}  // namespace hal::node::exchange
