#include "sim/scenario/action_section.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/scenario/agent_names.h"

namespace sim::scenario {
namespace {

using agents::AgentConfig;
using agents::Befall;
using agents::Drain;
using agents::Fortune;
using agents::Jam;
using agents::MoveTo;
using agents::Retune;
using agents::ScriptedAction;

constexpr Range kPower{1e-9, 1e6};              // mW
constexpr Range kEnergy{1e-9, 1e12};            // J
constexpr Range kWheelSpeed{1e-3, 1e3};         // rad/s
constexpr Range kBurst{1e-5, 1};                // s
constexpr std::string_view kTeleop = "teleop";  // driven by hand: there is no controller

struct FortuneKey {
  Fortune fortune;
  const char* meaning;
};
constexpr std::array<FortuneKey, 6> kFortunes{
    {{Fortune::kKill,
      "Ends the controllers of these agents (a name, or a pattern) as a crash would: they get no "
      "more events and the wheels stop after command_timeout, while radio and routing go on."},
     {Fortune::kRestart,
      "Starts new controllers for these agents, without any memory of the old ones, which are "
      "killed if they still run."},
     {Fortune::kSwitchOff,
      "Cuts the power of these agents' radios and motors; their controllers go on and are not "
      "told."},
     {Fortune::kSwitchOn, "Restores the power of these agents' radios and motors."},
     {Fortune::kAdd,
      "Adds these agents, which are absent, at their places and with new controllers."},
     {Fortune::kRemove, "Removes these agents: their bodies, radios and controllers."}}};

/// Why the action is impossible for the agent; empty if it is possible.
std::string objection(Fortune fortune, const AgentConfig& agent) {
  const bool is_power = fortune == Fortune::kSwitchOff || fortune == Fortune::kSwitchOn;
  if (is_power) return {};
  if (agent.inside) return "has a controller inside its network, whose other traffic would go on";
  if (agent.program == kTeleop) return "is teleoperated: there is no controller";
  const bool is_controllers = fortune == Fortune::kKill || fortune == Fortune::kRestart;
  if (is_controllers && agent.program.empty()) return "has no controller";
  if (!is_controllers && agent.network) return "has a network, whose programs stay";
  return {};
}

/// Notes why the action is impossible, for the first agent for which it is.
template <class Objection>
void object(Fields& io, const std::string& key, const ScriptedAction& action,
            const Scenario& scenario, Objection objection_to) {
  if (io.reading() == nullptr) return;
  for (const hal::AgentId id : action.agents) {
    const AgentConfig& agent = declared(id, scenario);
    const std::string why = objection_to(agent);
    if (why.empty()) continue;
    return io.mistake(key, fmt::format("{} {}", agent.name, why));
  }
}

/// The agents concerned, as the value of the key that names the action.
void whose_key(Fields& io, const Key& key, ScriptedAction& action, const Scenario& scenario) {
  io.needed_text(key, action.whose);
  if (Mapping* const in = io.reading(); in != nullptr && !action.whose.empty())
    action.agents = agents_meant(*in, key.name, action.whose, scenario);
}

void fortune_key(Fields& io, const FortuneKey& key, ScriptedAction& action,
                 const Scenario& scenario) {
  const std::string called(name(key.fortune));
  whose_key(io, {called, key.meaning, "NAME0"}, action, scenario);
  as<Befall>(action.what).fortune = key.fortune;
  object(io, called, action, scenario,
         [&](const AgentConfig& agent) { return objection(key.fortune, agent); });
}

void move_keys(Fields& io, ScriptedAction& action, const Scenario& scenario) {
  auto& [x, y, yaw] = as<MoveTo>(action.what).pose;
  whose_key(
      io,
      {"move", "Moves this agent's body to another place, where it stands upright and at rest.",
       "NAME0"},
      action, scenario);
  hal::Vec2 to{x, y};
  io.needed({"to", "With `move`: new position, world frame.", "[10 m, 5 m]"}, "m", kCoordinate, to);
  x = to.x;
  y = to.y;
  io.number({"yaw", "With `move`: new heading.", "90 deg"}, "rad", kAngle, yaw);
  if (action.agents.size() > 1) {
    io.mistake("move", fmt::format("'{}' matches {} agents, and only one can be moved to a place",
                                   action.whose, action.agents.size()));
  }
  object(io, "move", action, scenario, [](const AgentConfig& agent) {
    return has_body(agent) ? "" : "is a station: it stands, or moves on its path";
  });
}

void set_keys(Fields& io, ScriptedAction& action, const Scenario& scenario) {
  auto& [tx_power, wheel_speed] = as<Retune>(action.what);
  whose_key(io,
            {"set",
             "Changes values of these agents (a name, or a pattern) from now on. Parameters of "
             "controllers cannot be changed.",
             "'NAME*'"},
            action, scenario);
  const bool has_power =
      io.given({"tx_power", "With `set`: transmit power at the antenna, from the next frame on.",
                "10 mW", "as it was"},
               "mW", kPower, tx_power);
  if (has_power && radio::waves_of(scenario.simulation.radio) == nullptr)
    io.mistake("tx_power", "radios of this profile have no power");
  const bool has_speed = io.given(
      {"wheel_speed",
       "With `set`: largest angular speed of the wheels; later commands are scaled down to it.",
       "5 rad/s", "as it was"},
      "rad/s", kWheelSpeed, wheel_speed);
  if (has_speed) {
    object(io, "wheel_speed", action, scenario,
           [](const AgentConfig& agent) { return is_robot(agent) ? "" : "has no wheels"; });
  }
  if (!has_power && !has_speed) io.mistake("", "must have tx_power or wheel_speed, or both");
}

void drain_keys(Fields& io, ScriptedAction& action, const Scenario& scenario) {
  std::optional<double>& energy = as<Drain>(action.what).energy;
  std::optional<double>& level = as<Drain>(action.what).level;
  whose_key(
      io,
      {"drain", "Removes energy from the first battery of these agents (a name, or a pattern).",
       "'NAME*'"},
      action, scenario);
  const auto energy_key = [&](Fields& one) {
    double taken = energy.value_or(kEnergy.low);
    one.needed({"energy", "With `drain`: energy to remove; give this or `level`.", "500 J"}, "J",
               kEnergy, taken);
    energy = taken;
  };
  const auto level_key = [&](Fields& one) {
    double left = level.value_or(0);
    one.needed({"level",
                "With `drain`: state of charge to fall to, as a share of the capacity; has no "
                "effect if there is less already.",
                "0.2"},
               "1", {0, 1}, left);
    level = left;
    one.unused("energy", "cannot be combined with level");
  };
  const bool is_level = level.has_value();
  if (!io.first_of({{"level", is_level, level_key}, {"energy", !is_level, energy_key}}))
    energy_key(io);
  object(io, "drain", action, scenario,
         [](const AgentConfig& agent) { return has_battery(agent) ? "" : "has no battery"; });
}

void interferer_keys(Fields& io, Jam& c) {
  hal::Vec2 at{c.position.x, c.position.y};
  io.needed({"position", "Position of its antenna, world frame.", "[50 m, 20 m]"}, "m", kCoordinate,
            at);
  c.position = {at.x, at.y, c.position.z};
  io.number({"height", "Height of its antenna above the ground.", "1 m"}, "m", {0, 1e4},
            c.position.z);
  io.needed({"power", "Radiated power, the same in all directions.", "100 mW"}, "mW", kPower,
            c.power.value);
  io.given_count({"channel", "Channel whose whole bandwidth it occupies.", "6",
                  "that of the scenario's radio"},
                 1, radio::kLastChannel, c.channel);
  io.needed({"duration", "How long it stays.", "5 s"}, {1e-5, hal::files::config::kLongestDuration},
            c.duration);
  io.number({"duty_cycle", "Share of the time in which it transmits.", "0.5"}, "1", {1e-4, 1},
            c.duty_cycle);
  if (!io.is_writing()) c.period = 10ms;
  io.duration({"period", "Time from the start of one burst to the start of the next.", "10 ms"},
              kBurst, c.period);
}

void jam_key(Fields& io, ScriptedAction& action, const Scenario& scenario) {
  io.inside(
      {"jam", "Adds an interferer, which radiates bursts of energy that no receiver can decode."},
      [&](Fields& jam) {
        interferer_keys(jam, as<Jam>(action.what));
        if (radio::waves_of(scenario.simulation.radio) == nullptr)
          jam.mistake("", "radios of this profile know no interference");
      });
}

std::vector<Fields::Saying> sayings(ScriptedAction& action, const Scenario& scenario) {
  std::vector<Fields::Saying> all;
  all.reserve(kFortunes.size() + 4);
  for (const FortuneKey& key : kFortunes) {
    const auto* const befall = std::get_if<Befall>(&action.what);
    all.push_back({std::string(name(key.fortune)),
                   befall != nullptr && befall->fortune == key.fortune,
                   [&](Fields& io) { fortune_key(io, key, action, scenario); }});
  }
  const auto add = [&]<class Kind>(const char* key, Kind /*kind*/,
                                   void (*keys)(Fields&, ScriptedAction&, const Scenario&)) {
    all.push_back({key, std::holds_alternative<Kind>(action.what),
                   [&, keys](Fields& io) { keys(io, action, scenario); }});
  };
  add("move", MoveTo{}, move_keys);
  add("set", Retune{}, set_keys);
  add("drain", Drain{}, drain_keys);
  add("jam", Jam{}, jam_key);
  return all;
}

}  // namespace

void keys_of(Fields& io, ScriptedAction& action, const Scenario& scenario) {
  const std::vector<Fields::Saying> all = sayings(action, scenario);
  if (Mapping* const in = io.reading()) action.place = in->place();
  if (io.first_of(all)) return;
  io.mistake("",
             "must have an action: kill, restart, switch_off, switch_on, add, remove, move, set, "
             "drain or jam");
  for (const Fields::Saying& one : all) io.reading()->has(one.key);
}

}  // namespace sim::scenario
