#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hal/node/devices/robot_description.h"
#include "hal/node/exchange/session.h"
#include "hal/node/routing/routing_config.h"
#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/agents/condition.h"
#include "sim/agents/path.h"
#include "sim/agents/scripted_event.h"
#include "sim/air/network_config.h"
#include "sim/core/material.h"
#include "sim/physics/movable.h"
#include "sim/physics/world.h"
#include "sim/radio/radio_config.h"

namespace sim::agents {

enum class ControlPhase : std::uint8_t {
  kAligned,  ///< All agents and all control cycles start at time 0.
  /// Each agent and its control cycle start at a phase of less than one control period, drawn from
  /// its stream "<name>/control".
  kUniform,
};

/// Effect on the run of a controller process that died or does not answer.
enum class OnDeath : std::uint8_t {
  kFail,     ///< The run ends as failed.
  kSilence,  ///< Its agents stop driving after the command timeout; their radios continue.
};

/// What routing learns from the radio about its frames.
enum class LinkKind : std::uint8_t {
  kMac,      ///< Everything: result of each frame, received power, SNR.
  kUdpLike,  ///< Nothing, like a UDP socket. Transmission is the same.
};

/// Name of the network interface of an agent that has a network, as seen by its programs.
inline constexpr const char* kAirInterface = "wlan0";

/// An agent without a body: a radio that stays in place or moves on its path. It does not collide,
/// and sensors of robots do not detect it.
struct Station {
  PathDescription path;
  std::vector<hal::node::devices::SensorDescription> sensors{};  ///< Empty: it has no sensors.
  bool operator==(const Station&) const = default;
};

struct AgentConfig {
  hal::AgentId id;  ///< 1 .. kLastAddress
  std::string name;
  hal::Pose2 pose;  ///< At time 0, world frame.
  std::variant<hal::node::devices::MoteDescription, hal::node::devices::RobotDescription, Station>
      body;
  std::string program;  ///< Controller; empty: none, possible for agents with a network.
  std::vector<hal::node::exchange::ParameterText> parameters;
  radio::StationConfig radio{};  ///< Settings that differ from SimulationConfig::radio.
  /// nullopt: as in SimulationConfig::routing.
  std::optional<hal::node::routing::Algorithm> routing{};
  /// With Algorithm::kStatic: its routes.
  std::vector<hal::node::routing::StaticRoute> static_routes{};
  /// nullopt: programs cannot use its radio through sockets.
  std::optional<air::NetworkConfig> network{};
  bool inside = false;     ///< Its controller runs in the agent's own network namespace.
  bool is_present = true;  ///< At the start; an absent agent may be added by an event.
};

/// Whether its controller treats it as a robot; all others are motes.
inline bool is_robot(const AgentConfig& agent) {
  return std::holds_alternative<hal::node::devices::RobotDescription>(agent.body);
}
inline bool has_body(const AgentConfig& agent) {
  return !std::holds_alternative<Station>(agent.body);
}

inline const std::vector<hal::node::devices::SensorDescription>& sensors_of(
    const AgentConfig& agent) {
  return std::visit(
      [](const auto& body) -> const auto& { return body.sensors; }, agent.body);
}

/// Sensor of the positions of other agents, by a method that is not modelled (camera,
/// triangulation).
struct LocalisationConfig {
  hal::Metres range{300};
};

/// The run ends `after` an agent's controller enters a state, `after` a condition begins to hold,
/// or at a time.
struct EndCondition {
  std::optional<hal::AgentId> agent;  ///< nullopt, and no `when`: the run ends at time `after`.
  std::string state;
  hal::Duration after{};
  std::string result;  ///< Name of the result, e.g. "arrived".
  std::optional<Condition> when{};
};

/// Everything on which a run depends. Equal values and seed give equal runs.
struct SimulationConfig {
  std::uint64_t seed = 1;
  hal::Duration controller_latency{};
  ControlPhase control_phase = ControlPhase::kUniform;
  hal::Duration control_period{100'000'000};
  hal::Duration command_timeout{500'000'000};
  hal::Duration lateness_limit{1'000'000};  ///< For frames between programs and the air.
  OnDeath on_death = OnDeath::kFail;
  physics::WorldConfig world;
  std::vector<physics::StaticBox> walls;
  std::vector<Material> materials;  ///< Of walls, beside the built-in ones.
  std::vector<physics::Movable> movables;
  radio::RadioConfig radio;
  LinkKind link = LinkKind::kMac;
  hal::node::routing::RoutingConfig routing;
  LocalisationConfig localisation;
  std::vector<AgentConfig> agents;  ///< By address.
  std::vector<EndCondition> ends;
  std::vector<ScriptedEvent> script;  ///< Scripted events.
  /// Conditions for Simulation::holds() and has_held(). They do not affect the run.
  std::vector<Condition> asked;
};

}  // namespace sim::agents
