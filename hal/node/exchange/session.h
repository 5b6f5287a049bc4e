#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/channel.h"
#include "hal/types/robot_body.h"
#include "hal/types/time.h"
#include "hal/types/wants.h"

namespace hal::node::exchange {

/// Version of the types in this folder as transmitted. Peers with different versions refuse each
/// other.
inline constexpr std::uint32_t kProtocolVersion = 8;

/// A parameter as written in the scenario, with the place of its value for error messages.
struct ParameterText {
  std::string name;
  std::string value;  ///< With its unit, e.g. "15 s".
  std::string place;  ///< "file:line:column".
  bool is_list = false;
  std::vector<std::string> items{};  ///< Items of a list, whose `value` is empty.
  bool operator==(const ParameterText&) const = default;
};

/// Limits of the motors. Wheel speeds [rad/s] = rows of `body_to_wheel` times (vx, vy, omega).
struct DriveLimits {
  /// One row per driven wheel. Empty: no wheels.
  std::vector<std::array<double, 3>> body_to_wheel;
  /// (vx, vy, omega) = sum over the wheels of speed times row: the feasible motion that fits the
  /// speeds best. Empty: every motion is feasible.
  std::vector<std::array<double, 3>> wheel_to_body;
  double wheel_speed = 0;  ///< rad/s, limit of every wheel.
  bool operator==(const DriveLimits&) const = default;
};

/// One agent as described to its controller's process.
struct AgentSession {
  AgentId agent;
  std::string name;
  AgentKind kind = AgentKind::kMote;
  /// Seed of the run; the controller's random stream is (seed, "<name>/controller").
  std::uint64_t seed = 0;
  Duration control_period{};
  std::vector<ParameterText> parameters;
  std::vector<Channel> channels;
  DriveLimits limits;
  /// Network interface on which the controller may open its own sockets; empty: none.
  std::string air_interface{};
  RobotBody body{};  ///< Empty: the agent is no robot.
  bool operator==(const AgentSession&) const = default;
};

/// Address and name of an agent of the network.
struct AgentName {
  AgentId agent;
  std::string name;
  bool operator==(const AgentName&) const = default;
};

/// Introduction of a process.
struct Hello {
  std::uint32_t version = kProtocolVersion;
  std::string process;   ///< For messages: --name, default program.pid.
  std::string instance;  ///< Unique per process start.
  std::string program;   ///< Kind of controller it runs.
  std::string host;
  std::int64_t pid = 0;
  std::uint64_t pid_start_time = 0;   ///< Field 22 of /proc/<pid>/stat: distinguishes reused pids.
  std::vector<std::string> patterns;  ///< Names it requests; `*` and `?` match as in a shell.
  AgentKind kind = AgentKind::kMote;  ///< Kind of agent that it can drive.
  bool both_kinds = false;            ///< It can drive motes and robots.
  Wants wants;
  bool operator==(const Hello&) const = default;
};

/// The answer to a Hello: the granted agents, or a refusal with its reason.
struct Session {
  std::uint32_t version = kProtocolVersion;
  std::string server;
  std::string instance;  ///< Instance of the Hello that this answers.
  std::uint64_t run = 0;
  std::string refusal;  ///< Empty: granted.
  std::vector<AgentSession> agents;
  /// Once per process, for any number of agents; only if Wants::names requests it.
  std::vector<AgentName> directory{};
  bool operator==(const Session&) const = default;
};

}  // namespace hal::node::exchange
