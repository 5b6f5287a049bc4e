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
      "The controllers of these agents (a name, or a pattern) die, as by a crash: they are told "
      "nothing more, wheels stop after command_timeout, radio and routing live on."},
     {Fortune::kRestart,
      "The controllers of these agents begin anew and know nothing; those that live are killed."},
     {Fortune::kSwitchOff,
      "Radio and motors of these agents lose their power; the controllers live on and do not "
      "know."},
     {Fortune::kSwitchOn, "Radio and motors of these agents have their power again."},
     {Fortune::kAdd,
      "These agents, which are not there, come to their places with new controllers."},
     {Fortune::kRemove, "These agents are gone: bodies, radios, controllers."}}};

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
  whose_key(io, {"move", "This agent's body is somewhere else, at rest and upright.", "NAME0"},
            action, scenario);
  hal::Vec2 to{x, y};
  io.needed({"to", "With `move`: where, world frame.", "[10 m, 5 m]"}, "m", kCoordinate, to);
  x = to.x;
  y = to.y;
  io.number({"yaw", "With `move`: heading there.", "90 deg"}, "rad", kAngle, yaw);
  if (action.agents.size() > 1) {
    io.mistake("move", fmt::format("'{}' is {} agents, and only one can be there", action.whose,
                                   action.agents.size()));
  }
  object(io, "move", action, scenario, [](const AgentConfig& agent) {
    return has_body(agent) ? "" : "is a station: it stands, or moves on its path";
  });
}

void set_keys(Fields& io, ScriptedAction& action, const Scenario& scenario) {
  auto& [tx_power, wheel_speed] = as<Retune>(action.what);
  whose_key(io,
            {"set",
             "Values of these agents (a name, or a pattern) that are others from now on; "
             "parameters of controllers are not among them.",
             "'NAME*'"},
            action, scenario);
  const bool has_power = io.given(
      {"tx_power", "With `set`: into the antenna, from the next frame on.", "10 mW", "as it was"},
      "mW", kPower, tx_power);
  if (has_power && radio::waves_of(scenario.simulation.radio) == nullptr)
    io.mistake("tx_power", "radios of this profile have no power");
  const bool has_speed = io.given(
      {"wheel_speed", "With `set`: no wheel turns faster; the next command is scaled down.",
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
      {"drain", "Charge is taken out of the first battery of these agents (a name, or a pattern).",
       "'NAME*'"},
      action, scenario);
  const auto energy_key = [&](Fields& one) {
    double taken = energy.value_or(kEnergy.low);
    one.needed({"energy", "With `drain`: so much, or down to `level`.", "500 J"}, "J", kEnergy,
               taken);
    energy = taken;
  };
  const auto level_key = [&](Fields& one) {
    double left = level.value_or(0);
    one.needed({"level",
                "With `drain`: what is left, share of the capacity; if there is less already, "
                "nothing happens.",
                "0.2"},
               "1", {0, 1}, left);
    level = left;
    one.unused("energy", "cannot stand beside level");
  };
  const bool is_level = level.has_value();
  if (!io.first_of({{"level", is_level, level_key}, {"energy", !is_level, energy_key}}))
    energy_key(io);
  object(io, "drain", action, scenario,
         [](const AgentConfig& agent) { return has_battery(agent) ? "" : "has no battery"; });
}

void interferer_keys(Fields& io, Jam& c) {
  hal::Vec2 at{c.position.x, c.position.y};
  io.needed({"position", "Of its antenna, world frame.", "[50 m, 20 m]"}, "m", kCoordinate, at);
  c.position = {at.x, at.y, c.position.z};
  io.number({"height", "Of its antenna.", "1 m"}, "m", {0, 1e4}, c.position.z);
  io.needed({"power", "Radiated, the same in all directions.", "100 mW"}, "mW", kPower,
            c.power.value);
  io.given_count(
      {"channel", "Number of the channel that it fills.", "6", "that of the scenario's radio"}, 1,
      radio::kChannels, c.channel);
  io.needed({"duration", "How long.", "5 s"}, {1e-5, hal::files::config::kLongestDuration},
            c.duration);
  io.number({"duty_cycle", "Share of the time in which it sends.", "0.5"}, "1", {1e-4, 1},
            c.duty_cycle);
  if (!io.is_writing()) c.period = 10ms;
  io.duration({"period", "From burst to burst.", "10 ms"}, kBurst, c.period);
}

void jam_key(Fields& io, ScriptedAction& action, const Scenario& scenario) {
  io.inside({"jam", "An interferer: energy that nobody can receive, in bursts."}, [&](Fields& jam) {
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
             "must say what happens: kill, restart, switch_off, switch_on, add, remove, "
             "move, set, drain or jam");
  for (const Fields::Saying& one : all) io.reading()->has(one.key);
}

}  // namespace sim::scenario
