#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal/node/exchange/agent_table.h"
#include "sim/agents/agent_set.h"
#include "sim/agents/condition_watch.h"
#include "sim/agents/controllers.h"
#include "sim/agents/interfaces.h"
#include "sim/agents/movable_watch.h"
#include "sim/agents/observer_list.h"
#include "sim/agents/script.h"
#include "sim/agents/simulated_mote.h"
#include "sim/agents/simulation.h"
#include "sim/agents/world_obstacles.h"
#include "sim/radio/radio_network.h"

namespace sim::agents {

class SimulatedRobot;

/// The parts of a run and its loop. An instant (or, with a controller latency, a window of time) is
/// processed in rounds: its events run, all events for controllers are passed on together, and the
/// replies take effect; what they cause at the same instant starts the next round.
struct Simulation::State final : hal::node::agent::AgentListener {
  State(const SimulationConfig& config, const std::vector<Observer*>& observers);

  void on_inbox(hal::AgentId agent) override { waiting.insert(agent); }
  void on_state(hal::AgentId agent, const std::string& state) override;

  void start();
  void step_bodies();
  void end(std::string result);
  void fail(std::string error);

  /// Last instant of the window that begins at `begin`.
  hal::Time last_instant(hal::Time begin) const {
    const auto window = config.controller_latency;
    // A controller that waits by simulated time acts at the time of its events.
    if (window == hal::Duration::zero() || controllers.share_time()) return begin;
    return std::min(begin + window - hal::Duration{1}, until.value_or(hal::Time::max()));
  }
  bool take_outside(hal::Time now);
  void work_off(hal::Time begin);
  /// The events to be passed to controllers now, ordered by (time, agent, cause, arrival). Valid
  /// until the next call.
  std::vector<hal::node::exchange::Event>& take_events();
  void exchange(hal::Time window_end);
  void take_effect(Controllers::Answer answer);
  void on_error(hal::AgentId agent, const std::string& text, hal::Time event_time);
  void apply(const hal::node::exchange::Action& action);
  void apply_last(const hal::node::exchange::Action& action);
  /// Whether an action comes from a controller that has died since its event.
  bool is_of_dead(hal::AgentId agent, hal::Time event_time) const;
  void on_end(const EndCondition& condition);
  void watch_conditions();

  // Scripted actions.
  void act(const ScriptedAction& action, std::size_t event);
  /// Actions other than `add` have no effect on an agent that is not present.
  void act_on(hal::AgentId agent, const ScriptedAction& action, std::size_t event);
  void befall(Fortune fortune, hal::AgentId agent);
  /// Lets the agent take part from now on, with a new controller.
  void join(hal::AgentId agent);
  void begin_anew(hal::AgentId agent);
  /// Lets the agents take part whose bodies the physics step has placed.
  void let_arrive();
  void kill(hal::AgentId agent);
  void place(hal::AgentId agent, const hal::Pose2& pose);
  void retune(hal::AgentId agent, const Retune& values);
  void drain(hal::AgentId agent, const Drain& drain);
  void jam(const Jam& interferer, hal::Time last);
  void on_failures(const std::vector<Controllers::Failure>& failures);
  void serve_outsiders(hal::Time next);
  void go_on(hal::Time next, Pace& pace);
  /// Lets the sampler take the samples due before `next`. @pre no event is pending before `next`.
  void look_before(hal::Time next) {
    if (look_due < next) look_until(next);
  }
  void look_until(hal::Time next);
  /// Advances to `until` if the run has not ended before, lets the sampler sample up to that time,
  /// and evaluates the conditions at the last instant.
  void look_at_the_end(std::optional<hal::Time> until);
  void stop_agents();
  void stop_controllers();
  AgentView view(hal::AgentId agent);
  Outcome outcome() const;

  const SimulationConfig config;
  ObserverList observers;
  OutsideInput outside;  ///< Destroyed after the controllers, whose threads may put something in.
  EventQueue events;
  std::unique_ptr<physics::World> world;
  Paths paths;
  Scene scene;
  AgentPositions positions;
  WorldObstacles obstacles;
  radio::RadioNetwork air;
  Interfaces interfaces;
  hal::node::exchange::AgentTable<std::unique_ptr<SimulatedMote>> agents;
  MovableWatch movables;
  std::vector<SimulatedRobot*> fed_robots;  ///< Those with batteries, by address.
  Controllers controllers;
  AgentSet waiting;  ///< With events in their inbox.
  /// Results of take_events(), kept for their memory: with thousands of events per round,
  /// megabytes.
  std::vector<hal::node::exchange::Event> taken, taken_by_time;
  std::optional<hal::Time> until;
  std::optional<std::string> result;  ///< Set when the run has ended.
  std::string error;
  unsigned instants_until_look = 0;  ///< See serve_outsiders().
  bool broken_off = false;
  Sampler* sampler = nullptr;
  hal::Time look_due = hal::Time::max();  ///< Time of the sampler's next sample.
  std::vector<std::string> bodies_lost;   ///< One line for each lost body.
  ConditionWatch watch;
  std::vector<std::size_t> asked;  ///< Numbers of SimulationConfig::asked in the watch.
  Script script;
  std::map<hal::AgentId, hal::Wants> wants;  ///< What the agents' controllers want.
  /// Time of the last scripted death of each controller.
  std::map<hal::AgentId, hal::Time> died_at;
  std::vector<hal::AgentId> dead;  ///< Agents whose controllers the script killed.
  std::vector<hal::node::exchange::Event> farewells;  ///< Their last events.
  std::vector<hal::AgentId> displaced;                ///< Since the last physics step.
  /// For agents that appear with the next physics step: actions to be done to them then.
  std::map<hal::AgentId, std::vector<std::pair<const ScriptedAction*, std::size_t>>> arriving;
};

}  // namespace sim::agents
