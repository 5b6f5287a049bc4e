// The part of a run that performs scripted actions.
#include <algorithm>
#include <variant>

#include "hal/types/check.h"
#include "hal/types/log.h"
#include "sim/agents/parking.h"
#include "sim/agents/simulated_robot.h"
#include "sim/agents/simulation_state.h"

namespace sim::agents {

namespace {

bool is_add(const ScriptedAction& action) {
  const auto* befall = std::get_if<Befall>(&action.what);
  return befall != nullptr && befall->fortune == Fortune::kAdd;
}

}  // namespace

void Simulation::State::act(const ScriptedAction& action, std::size_t event) {
  if (const auto* interferer = std::get_if<Jam>(&action.what)) {
    jam(*interferer, events.now() + interferer->duration);
    observers.on_scripted({events.now(), event, name(action)});
  }
  for (const hal::AgentId agent : action.agents) act_on(agent, action, event);
}

void Simulation::State::act_on(hal::AgentId agent, const ScriptedAction& action,
                               std::size_t event) {
  const auto coming = arriving.find(agent);
  if (coming != arriving.end()) return void(coming->second.emplace_back(&action, event));
  if (!agents.at(agent)->is_present() && !is_add(action)) {
    hal::log::warning(events.now(), agents.at(agent)->name(),
                      "the scenario: {}: no effect, it is not present ({})", name(action),
                      action.place);
    return;
  }
  hal::log::info(events.now(), agents.at(agent)->name(), "the scenario: {}", name(action));
  observers.on_scripted({events.now(), event, name(action), agent});
  if (const auto* one = std::get_if<Befall>(&action.what)) befall(one->fortune, agent);
  if (const auto* one = std::get_if<MoveTo>(&action.what)) place(agent, one->pose);
  if (const auto* one = std::get_if<Retune>(&action.what)) retune(agent, *one);
  if (const auto* one = std::get_if<Drain>(&action.what)) drain(agent, *one);
}

void Simulation::State::befall(Fortune fortune, hal::AgentId id) {
  SimulatedMote& agent = *agents.at(id);
  switch (fortune) {
    case Fortune::kKill:
      return kill(id);
    case Fortune::kRestart:
      return begin_anew(id);
    case Fortune::kSwitchOff:
    case Fortune::kSwitchOn:
      return agent.set_power(fortune == Fortune::kSwitchOn);
    case Fortune::kAdd:
      if (agent.is_present()) return;
      if (!has_body(agent.config())) return join(id);
      place(id, agent.config().pose);
      arriving[id];
      return;
    case Fortune::kRemove:
      kill(id);
      agent.set_present(false);
      if (has_body(agent.config())) place(id, parking(id));
      return watch.on_removed(id);
  }
}

void Simulation::State::join(hal::AgentId agent) {
  agents.at(agent)->set_present(true);
  begin_anew(agent);
}

void Simulation::State::begin_anew(hal::AgentId agent) {
  kill(agent);
  if (agents.at(agent)->config().program.empty()) return;
  std::erase(dead, agent);
  agents.at(agent)->begin_anew(wants.at(agent));
}

void Simulation::State::let_arrive() {
  for (const auto& [agent, meanwhile] : std::exchange(arriving, {})) {
    join(agent);
    for (const auto& [action, event] : meanwhile) act_on(agent, *action, event);
  }
}

void Simulation::State::kill(hal::AgentId agent) {
  died_at[agent] = events.now();
  watch.forget_state(agent);
  if (!agents.at(agent)->core().is_connected()) return;
  agents.at(agent)->silence(events.now() + config.command_timeout);
  dead.push_back(agent);
  waiting.erase(agent);
}

void Simulation::State::place(hal::AgentId agent, const hal::Pose2& pose) {
  world->place(agent, pose);
  displaced.push_back(agent);
}

void Simulation::State::retune(hal::AgentId agent, const Retune& values) {
  if (values.tx_power) air.set_tx_power(agent, *values.tx_power);
  if (!values.wheel_speed) return;
  auto* robot = dynamic_cast<SimulatedRobot*>(agents.at(agent).get());
  BARAKA_CHECK(robot != nullptr);  // the scenario was checked
  robot->limit_wheels(*values.wheel_speed);
}

void Simulation::State::drain(hal::AgentId id, const Drain& drain) {
  Supply* const supply = agents.at(id)->supply();
  BARAKA_CHECK(supply != nullptr);  // the scenario was checked
  const hal::node::devices::Discharge battery = supply->battery();
  const double to_level = drain.level ? (battery.charge() - *drain.level) * battery.capacity() : 0;
  supply->take(drain.energy ? *drain.energy : std::max(0.0, to_level));
}

/// Sends one burst, and schedules the next until `last`.
void Simulation::State::jam(const Jam& interferer, hal::Time last) {
  const auto length = hal::from_seconds(interferer.duty_cycle * hal::to_seconds(interferer.period));
  const auto& [x, y, height] = interferer.position;
  const hal::Vec3 foot = on(*config.world.ground, {x, y});
  air.interfere({.from = {x, y, foot.z + height},
                 .power = interferer.power,
                 .channel = interferer.channel,
                 .length = std::min(length, last - events.now())});
  const hal::Time next = events.now() + interferer.period;
  if (next >= last) return;
  events.schedule(next, Rank::kScenario, kWorld,
                  [this, &interferer, last] { jam(interferer, last); });
}

}  // namespace sim::agents
