#include "sim/scenario/action_section.h"

#include <fmt/format.h>

#include <array>
#include <string>

#include "sim/scenario/agent_names.h"
#include "sim/scenario/given_keys.h"

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

/// Why it cannot befall the agent; empty: it can.
std::string objection(Fortune fortune, const AgentConfig& agent) {
  const bool is_power = fortune == Fortune::kSwitchOff || fortune == Fortune::kSwitchOn;
  if (is_power) return {};
  if (agent.inside) return "has a controller inside its network, which goes on by the wall clock";
  if (agent.program == kTeleop) return "is teleoperated: there is no controller";
  const bool is_controllers = fortune == Fortune::kKill || fortune == Fortune::kRestart;
  if (is_controllers && agent.program.empty()) return "has no controller";
  if (!is_controllers && agent.network) return "has a network, whose programs stay";
  return {};
}

/// Notes why it cannot be done, of the first agent of which it cannot.
template <class Objection>
void object(Mapping& in, const std::string& key, const ScriptedAction& action,
            const Scenario& scenario, Objection objection_to) {
  for (const hal::AgentId id : action.agents) {
    const AgentConfig& agent = declared(id, scenario);
    const std::string why = objection_to(agent);
    if (why.empty()) continue;
    return in.mistake(key, fmt::format("{} {}", agent.name, why));
  }
}

void read_who(Mapping& in, const std::string& key, std::string whose, const Scenario& scenario,
              ScriptedAction& action) {
  action.whose = std::move(whose);
  if (!action.whose.empty()) action.agents = agents_meant(in, key, action.whose, scenario);
}

void read_fortune(Mapping& in, const FortuneKey& key, const Scenario& scenario,
                  ScriptedAction& action) {
  const std::string called(name(key.fortune));
  read_who(in, called, in.text({called, key.meaning, "NAME0"}), scenario, action);
  action.what = Befall{key.fortune};
  object(in, called, action, scenario,
         [&](const AgentConfig& agent) { return objection(key.fortune, agent); });
}

void read_move(Mapping& in, const Scenario& scenario, ScriptedAction& action) {
  read_who(in, "move",
           in.text({"move", "This agent's body is somewhere else, at rest and upright.", "NAME0"}),
           scenario, action);
  const hal::Vec2 to =
      in.vec2({"to", "With `move`: where, world frame.", "[10 m, 5 m]"}, "m", kCoordinate);
  const double yaw = in.number({"yaw", "With `move`: heading there.", "90 deg"}, "rad", kAngle, 0);
  action.what = MoveTo{{to.x, to.y, yaw}};
  if (action.agents.size() > 1) {
    in.mistake("move", fmt::format("'{}' is {} agents, and only one can be there", action.whose,
                                   action.agents.size()));
  }
  object(in, "move", action, scenario, [](const AgentConfig& agent) {
    return has_body(agent) ? "" : "is a station: it stands, or moves on its path";
  });
}

void read_set(Mapping& in, const Scenario& scenario, ScriptedAction& action) {
  read_who(in, "set",
           in.text({"set",
                    "Values of these agents (a name, or a pattern) that are others from "
                    "now on; parameters of controllers are not among them.",
                    "'NAME*'"}),
           scenario, action);
  Retune values;
  const GivenKeys keys(in);
  const bool has_power = keys.has("tx_power"), has_speed = keys.has("wheel_speed");
  if (!has_power && !has_speed) in.mistake("", "must have tx_power or wheel_speed, or both");
  if (has_power) {
    values.tx_power = hal::Milliwatts{
        in.number({"tx_power", "With `set`: into the antenna, from the next frame on.", "10 mW"},
                  "mW", kPower)};
    if (radio::waves_of(scenario.simulation.radio) == nullptr)
      in.mistake("tx_power", "radios of this profile have no power");
  }
  if (has_speed) {
    values.wheel_speed = in.number(
        {"wheel_speed", "With `set`: no wheel turns faster; the next command is scaled down.",
         "5 rad/s"},
        "rad/s", kWheelSpeed);
    object(in, "wheel_speed", action, scenario,
           [](const AgentConfig& agent) { return is_robot(agent) ? "" : "has no wheels"; });
  }
  action.what = values;
}

void read_drain(Mapping& in, const Scenario& scenario, ScriptedAction& action) {
  read_who(in, "drain",
           in.text({"drain",
                    "Charge is taken out of the first battery of these agents (a name, "
                    "or a pattern).",
                    "'NAME*'"}),
           scenario, action);
  const GivenKeys keys(in);
  Drain drain;
  if (keys.has("level")) {
    drain.level = in.number({"level",
                             "With `drain`: what is left, share of the capacity; if there is less "
                             "already, nothing happens.",
                             "0.2"},
                            "1", {0, 1});
    if (!keys.is_survey()) in.refuse("energy", "cannot stand beside level");
  }
  if (!keys.has("level") || keys.is_survey()) {
    drain.energy =
        in.number({"energy", "With `drain`: so much, or down to `level`.", "500 J"}, "J", kEnergy);
  }
  object(in, "drain", action, scenario,
         [](const AgentConfig& agent) { return has_battery(agent) ? "" : "has no battery"; });
  action.what = drain;
}

void read_jam(Mapping in, const Scenario& scenario, ScriptedAction& action) {
  Jam jam;
  const hal::Vec2 at =
      in.vec2({"position", "Of its antenna, world frame.", "[50 m, 20 m]"}, "m", kCoordinate);
  jam.position = {at.x, at.y, in.number({"height", "Of its antenna.", "1 m"}, "m", {0, 1e4}, 0)};
  jam.power = hal::Milliwatts{
      in.number({"power", "Radiated, the same in all directions.", "100 mW"}, "mW", kPower)};
  if (GivenKeys(in).has("channel")) {
    jam.channel = static_cast<std::uint32_t>(in.integer(
        {"channel", "Number of the channel that it fills.", "6", "that of the scenario's radio"}, 1,
        14));
  }
  GivenKeys(in).offer(in, {"channel"});
  jam.duration =
      in.duration({"duration", "How long.", "5 s"}, {1e-5, hal::config::kLongestDuration});
  jam.duty_cycle =
      in.number({"duty_cycle", "Share of the time in which it sends.", "0.5"}, "1", {1e-4, 1}, 1);
  jam.period = in.duration({"period", "From burst to burst.", "10 ms"}, kBurst, 10ms);
  in.finish();
  action.what = jam;
  if (radio::waves_of(scenario.simulation.radio) == nullptr)
    in.mistake("", "radios of this profile know no interference");
}

/// Writes what an action does to its agents.
struct WriteAction {
  Writer& out;
  const ScriptedAction& action;

  void operator()(const Befall& befall) const { out.text(name(befall.fortune), action.whose); }
  void operator()(const MoveTo& move) const {
    out.text("move", action.whose);
    out.numbers("to", {move.pose.x, move.pose.y}, "m");
    out.number("yaw", move.pose.theta, "rad");
  }
  void operator()(const Retune& values) const {
    out.text("set", action.whose);
    if (values.tx_power) out.number("tx_power", values.tx_power->value, "mW");
    if (values.wheel_speed) out.number("wheel_speed", *values.wheel_speed, "rad/s");
  }
  void operator()(const Drain& drain) const {
    out.text("drain", action.whose);
    if (drain.energy) out.number("energy", *drain.energy, "J");
    if (drain.level) out.number("level", *drain.level, "1");
  }
  void operator()(const Jam& jam) const {
    out.open("jam");
    out.numbers("position", {jam.position.x, jam.position.y}, "m");
    out.number("height", jam.position.z, "m");
    out.number("power", jam.power.value, "mW");
    if (jam.channel) out.integer("channel", *jam.channel);
    out.duration("duration", jam.duration);
    out.number("duty_cycle", jam.duty_cycle, "1");
    out.duration("period", jam.period);
    out.close();
  }
};

/// An action that says no kind; all of them are known here.
void refuse_nothing(Mapping& in) {
  in.mistake("",
             "must say what happens: kill, restart, switch_off, switch_on, add, remove, "
             "move, set, drain or jam");
  for (const FortuneKey& key : kFortunes) in.has(std::string(name(key.fortune)));
  for (const char* key : {"move", "set", "drain", "jam"}) in.has(key);
}

}  // namespace

ScriptedAction read_action(Mapping in, const Scenario& scenario) {
  ScriptedAction action;
  action.place = in.place();
  const GivenKeys keys(in);
  bool is_said = false;
  const auto is_it = [&](std::string_view key) {
    if (!keys.has(key) || (is_said && !keys.is_survey())) return false;
    is_said = true;
    return true;
  };
  for (const FortuneKey& key : kFortunes) {
    if (is_it(name(key.fortune))) read_fortune(in, key, scenario, action);
  }
  if (is_it("move")) read_move(in, scenario, action);
  if (is_it("set")) read_set(in, scenario, action);
  if (is_it("drain")) read_drain(in, scenario, action);
  if (is_it("jam")) {
    read_jam(in.mapping({"jam", "An interferer: energy that nobody can receive, in bursts."}),
             scenario, action);
  }
  if (!is_said) refuse_nothing(in);
  in.finish();
  return action;
}

void write_action(Writer& out, const ScriptedAction& action) {
  std::visit(WriteAction{out, action}, action.what);
}

}  // namespace sim::scenario
