#include "sim/agents/simulation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "hal/types/check.h"
#include "hal/types/log.h"
#include "sim/agents/controllers.h"
#include "sim/agents/observer_list.h"
#include "sim/agents/simulated_agent.h"
#include "sim/agents/simulated_robot.h"
#include "sim/radio/radio_network.h"

namespace sim::agents {
namespace {

using hal::exchange::Action;
using hal::exchange::ActionKind;
using hal::exchange::Event;

/// Makes every body. Order of declaration is part of the run's identity.
void populate(physics::World& world, const SimulationConfig& config) {
  for (const physics::StaticBox& wall : config.walls) world.add_wall(wall);
  for (const AgentConfig& agent : config.agents) {
    if (const auto* mote = std::get_if<hal::devices::MoteDescription>(&agent.body)) {
      world.add_mote(agent.id, *mote, agent.pose);
    } else {
      world.add_robot(agent.id, std::get<hal::devices::RobotDescription>(agent.body), agent.pose);
    }
  }
}

/// Bound on the speed of every body, m/s: twice the fastest robot's, for what a robot pushes; 0 if
/// there is no robot.
double speed_bound(const physics::World& world, const SimulationConfig& config) {
  double bound = 0;
  for (const AgentConfig& agent : config.agents) {
    if (!std::holds_alternative<hal::devices::RobotDescription>(agent.body)) continue;
    const hal::Twist2 limits = world.drive(agent.id).limits();
    bound = std::max({bound, 2 * limits.vx, 2 * limits.vy});
  }
  return bound;
}

std::vector<hal::AgentId> ids(const SimulationConfig& config) {
  std::vector<hal::AgentId> ids;
  for (const AgentConfig& agent : config.agents) ids.push_back(agent.id);
  return ids;
}

std::vector<radio::RadioNetwork::Station> stations(const SimulationConfig& config) {
  std::vector<radio::RadioNetwork::Station> stations;
  for (const AgentConfig& agent : config.agents) stations.push_back({agent.id, agent.name});
  return stations;
}

}  // namespace

/// The parts of a run and its loop. An instant (or, with a controller latency, a window of time) is
/// worked off in rounds: its events run, what they have for controllers is handed over all at once,
/// and the answers take effect; what they cause at the same instant starts the next round.
struct Simulation::State final : AgentListener {
  State(const SimulationConfig& the_config, std::vector<Observer*> the_observers)
      : config(the_config),
        observers(std::move(the_observers)),
        world((populated(the_config))),
        scene(*world, ids(config)),
        positions(*world, speed_bound(*world, config)),
        obstacles(*world),
        air(config.radio, stations(config),
            {.events = events,
             .positions = positions,
             .obstacles = obstacles,
             .observer = observers,
             .seed = config.seed}) {
    const Surroundings surroundings{events, *world, scene, observers, config};
    for (const AgentConfig& agent : config.agents) {
      auto& made = agents[agent.id];
      if (std::holds_alternative<hal::devices::RobotDescription>(agent.body)) {
        made = std::make_unique<SimulatedRobot>(agent, air.sap(agent.id), surroundings, *this);
      } else {
        made = std::make_unique<SimulatedAgent>(agent, air.sap(agent.id), surroundings, *this);
      }
    }
  }

  static std::unique_ptr<physics::World> populated(const SimulationConfig& config) {
    auto world = std::make_unique<physics::World>(config.world);
    populate(*world, config);
    return world;
  }

  void on_inbox(hal::AgentId agent) override { waiting.push_back(agent); }
  void on_state(hal::AgentId agent, const std::string& state) override;

  void start();
  void step_bodies();
  void end(std::string result);
  void fail(std::string error);

  bool within(hal::Time next, hal::Time begin) const {
    const auto window = config.controller_latency;
    if (window == hal::Duration::zero()) return next == begin;
    return next < begin + window && (!until || next <= *until);
  }
  void work_off(hal::Time begin);
  std::vector<Event> take_events();
  void exchange(hal::Time window_end);
  void take_effect(Controllers::Answer answer);
  void apply(const Action& action);
  void apply_last(const Action& action);
  void on_failures(const std::vector<Controllers::Failure>& failures);
  void go_on(hal::Time next, Pace& pace);
  void stop_controllers();
  Outcome outcome(Outcome::Kind kind, std::string result) const;

  const SimulationConfig config;
  ObserverList observers;
  EventQueue events;
  std::unique_ptr<physics::World> world;
  Scene scene;
  BodyPositions positions;
  WallObstacles obstacles;
  radio::RadioNetwork air;
  std::map<hal::AgentId, std::unique_ptr<SimulatedAgent>> agents;
  Controllers controllers;
  std::vector<hal::AgentId> waiting;  ///< Agents with something in the inbox; repeats allowed.
  std::optional<hal::Time> until;
  std::optional<std::string> result;  ///< Set when the run has ended.
  std::string error;
  bool broken_off = false;
  std::uint64_t refused = 0;
  std::vector<std::string> bodies_lost;  ///< One line for each of the world's lost bodies.
};

void Simulation::State::on_state(hal::AgentId agent, const std::string& state) {
  for (const EndCondition& condition : config.ends) {
    if (condition.agent != agent || condition.state != state) continue;
    events.schedule(events.now() + condition.after, Rank::kScenario, kWorld,
                    [this, &condition] { end(condition.result); });
  }
}

void Simulation::State::start() {
  observers.on_start(air.links());
  for (const auto& [id, agent] : agents) agent->start();
  events.schedule(hal::Time{} + config.world.step, Rank::kPhysics, kWorld,
                  [this] { step_bodies(); });
  for (const EndCondition& condition : config.ends) {
    if (condition.agent) continue;
    events.schedule(hal::Time{} + condition.after, Rank::kScenario, kWorld,
                    [this, &condition] { end(condition.result); });
  }
}

void Simulation::State::step_bodies() {
  world->step();
  for (const physics::LostBody& lost : world->lost_bodies().subspan(bodies_lost.size())) {
    const std::string& name = agents.at(lost.agent)->name();
    hal::log::warning(events.now(), name, "{}", physics::name(lost.how));
    bodies_lost.push_back(
        fmt::format("{} {} at {:.9f} s", name, physics::name(lost.how), hal::to_seconds(lost.at)));
    observers.on_body_lost(lost);
  }
  events.schedule(events.now() + config.world.step, Rank::kPhysics, kWorld,
                  [this] { step_bodies(); });
}

void Simulation::State::end(std::string with) {
  if (!result) result = std::move(with);
}

void Simulation::State::fail(std::string with) {
  if (error.empty()) error = std::move(with);
  end("failed");
}

void Simulation::State::work_off(hal::Time begin) {
  while (!result) {
    const auto next = events.next_time();
    if (!next || !within(*next, begin)) break;
    events.run_next();
  }
}

std::vector<Event> Simulation::State::take_events() {
  std::sort(waiting.begin(), waiting.end());
  waiting.erase(std::unique(waiting.begin(), waiting.end()), waiting.end());
  std::vector<Event> taken;
  for (const hal::AgentId agent : waiting) {
    std::vector<Event> events_of_agent = agents.at(agent)->take_events();
    std::move(events_of_agent.begin(), events_of_agent.end(), std::back_inserter(taken));
  }
  waiting.clear();
  // By agent already, and by cause within; with a window of time, time comes first.
  std::stable_sort(taken.begin(), taken.end(),
                   [](const Event& a, const Event& b) { return a.time < b.time; });
  return taken;
}

void Simulation::State::exchange(hal::Time window_end) {
  std::vector<Event> taken = take_events();
  if (taken.empty()) return;
  Controllers::Round round = controllers.exchange(std::move(taken), window_end);
  refused += round.refused;
  on_failures(round.failures);
  for (Controllers::Answer& answer : round.answers) {
    if (error.empty()) take_effect(std::move(answer));
  }
}

void Simulation::State::take_effect(Controllers::Answer answer) {
  if (answer.action.kind == ActionKind::kError) {
    const hal::AgentId agent = answer.action.agent;
    fail(fmt::format("the controller of {} (process {}) failed at {:.9f} s: {}",
                     agents.at(agent)->name(), controllers.process_of(agent),
                     hal::to_seconds(answer.event_time), answer.action.text));
    return;
  }
  if (config.controller_latency == hal::Duration::zero()) {
    apply(answer.action);
    return;
  }
  events.schedule(
      answer.event_time + config.controller_latency, Rank::kAction, answer.action.agent,
      [this, action = std::make_shared<Action>(std::move(answer.action))] { apply(*action); });
}

void Simulation::State::apply(const Action& action) {
  if (const auto applied = agents.at(action.agent)->apply(action); !applied) {
    ++refused;
    hal::log::warning(events.now(), agents.at(action.agent)->name(), "action refused: {}",
                      applied.error().message);
  }
}

/// After the end only words count: states and log lines.
void Simulation::State::apply_last(const Action& action) {
  if (action.kind == ActionKind::kState || action.kind == ActionKind::kLog) apply(action);
}

void Simulation::State::on_failures(const std::vector<Controllers::Failure>& failures) {
  for (const Controllers::Failure& failure : failures) {
    std::vector<std::string_view> names;
    for (const hal::AgentId agent : controllers.agents_of(failure.port)) {
      names.push_back(agents.at(agent)->name());
    }
    const std::string what = fmt::format("{} (agents {}) at {:.9f} s", failure.error.message,
                                         fmt::join(names, ", "), hal::to_seconds(events.now()));
    if (config.on_death == OnDeath::kFail) {
      fail(what);
      continue;
    }
    hal::log::warning(events.now(), "run", "{}; they fall silent", what);
    controllers.drop(failure.port);
    for (const hal::AgentId agent : controllers.agents_of(failure.port)) {
      agents.at(agent)->silence(events.now() + config.command_timeout);
    }
  }
}

void Simulation::State::stop_controllers() {
  for (const auto& [id, agent] : agents) agent->add_stop_event();
  Controllers::Round round = controllers.exchange(take_events(), events.now());
  refused += round.refused;
  for (const Controllers::Failure& failure : round.failures) {
    hal::log::warning(events.now(), "run", "at the stop: {}", failure.error.message);
  }
  for (const Controllers::Answer& answer : round.answers) apply_last(answer.action);
}

Outcome Simulation::State::outcome(Outcome::Kind kind, std::string the_result) const {
  return {.kind = kind,
          .result = std::move(the_result),
          .error = error,
          .ended_at = events.now(),
          .events = events.executed(),
          .exchanges = controllers.exchanges(),
          .refused_actions = refused,
          .ode_messages = world->solver_messages(),
          .bodies_lost = bodies_lost};
}

/// Works off what is due next, when it is time.
void Simulation::State::go_on(hal::Time next, Pace& pace) {
  switch (pace.may_go_on(next, {events.now(), events.executed(), controllers.exchanges()})) {
    case Pace::Verdict::kBreakOff:
      broken_off = true;
      return;
    case Pace::Verdict::kAskAgain:
      return on_failures(controllers.find_dead());
    case Pace::Verdict::kGoOn:
      work_off(next);
      if (!result) exchange(next + config.controller_latency);
  }
}

Simulation::Simulation(const SimulationConfig& config, std::vector<Observer*> observers)
    : state_(std::make_unique<State>(config, std::move(observers))) {}

Simulation::~Simulation() = default;

std::vector<hal::exchange::AgentOffer> Simulation::offers() const {
  std::vector<hal::exchange::AgentOffer> offers;
  for (const auto& [id, agent] : state_->agents) offers.push_back(agent->offer());
  return offers;
}

void Simulation::connect(std::shared_ptr<hal::exchange::ControllerPort> port,
                         const std::vector<hal::AgentId>& agents, const hal::Wants& wants) {
  for (const hal::AgentId agent : agents) state_->agents.at(agent)->connect(wants);
  state_->controllers.connect(std::move(port), agents);
}

Outcome Simulation::run(std::optional<hal::Time> until, Pace& pace) {
  State& s = *state_;
  for (const auto& [id, agent] : s.agents) BARAKA_CHECK(s.controllers.is_connected(id));
  s.until = until;
  s.start();
  while (!s.result && !s.broken_off) {
    const auto next = s.events.next_time();
    if (!next || (until && *next > *until)) break;
    s.go_on(*next, pace);
  }
  if (!s.error.empty()) return s.outcome(Outcome::Kind::kFailed, "failed");
  if (!s.result && !s.broken_off && until) s.events.advance_to(*until);
  s.stop_controllers();
  if (s.broken_off) return s.outcome(Outcome::Kind::kInterrupted, "interrupted");
  return s.result ? s.outcome(Outcome::Kind::kEnded, *s.result)
                  : s.outcome(Outcome::Kind::kUntil, "until");
}

BodyState Simulation::body(hal::AgentId agent) const { return state_->scene.body(agent); }

ContactCounts Simulation::contacts(hal::AgentId agent) const {
  const physics::Contacts& contacts = state_->world->contacts(agent);
  return {.wall_steps = contacts.walls.steps,
          .object_steps = contacts.motes.steps + contacts.robots.steps};
}

const std::string& Simulation::state(hal::AgentId agent) const {
  return state_->agents.at(agent)->last_state();
}

}  // namespace sim::agents
