#include "sim/agents/simulation.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "hal/types/check.h"
#include "sim/agents/populated_world.h"
#include "sim/agents/real_time_run.h"
#include "sim/agents/simulated_robot.h"
#include "sim/agents/simulation_state.h"
#include "sim/core/large_pages.h"

namespace sim::agents {
namespace {

/// Bound of the speed at which a falling movable pushes a body [m/s].
constexpr double kFallingSpeed = 1;

/// Of heap. A station with its radio, its controller in process and its part of the record takes
/// 27 kB (1000 of tests/bench/beacons).
constexpr std::size_t kBytesPerAgent = 40'000;

/// Upper bound of the speed of every body [m/s]: twice that of the fastest robot or movable, to
/// include pushed bodies; 0 without any.
double speed_bound(const physics::World& world, const SimulationConfig& config) {
  double bound = 0;
  for (const AgentConfig& agent : config.agents) {
    if (!is_robot(agent)) continue;
    const hal::Twist2 limits = world.drive(agent.id).limits();
    bound = std::max({bound, 2 * limits.vx, 2 * limits.vy});
  }
  for (const physics::Movable& movable : config.movables)
    bound = std::max(
        {bound, kFallingSpeed, 2 * std::abs(movable.velocity.x), 2 * std::abs(movable.velocity.y)});
  return bound;
}

std::vector<hal::AgentId> ids(const SimulationConfig& config) {
  std::vector<hal::AgentId> ids;
  for (const AgentConfig& agent : config.agents) ids.push_back(agent.id);
  return ids;
}

/// Largest power that the script sets for an agent's radio; 0 if it sets none.
hal::Milliwatts most_power(hal::AgentId agent, const SimulationConfig& config) {
  hal::Milliwatts most{};
  for (const ScriptedEvent& event : config.script) {
    for (const ScriptedAction& action : event.actions) {
      const auto* values = std::get_if<Retune>(&action.what);
      if (values == nullptr || !values->tx_power) continue;
      if (std::ranges::find(action.agents, agent) != action.agents.end())
        most = std::max(most, *values->tx_power);
    }
  }
  return most;
}

std::vector<radio::RadioNetwork::Station> stations(const SimulationConfig& config) {
  std::vector<radio::RadioNetwork::Station> stations;
  for (const AgentConfig& agent : config.agents) {
    stations.push_back({agent.id, agent.name, agent.radio, most_power(agent.id, config)});
  }
  return stations;
}

}  // namespace

Simulation::State::State(const SimulationConfig& the_config,
                         const std::vector<Observer*>& the_observers)
    : config(the_config),
      observers(the_observers),
      world(populated_world(the_config)),
      paths(config),
      scene(*world, ids(config), &paths),
      positions(*world, paths, speed_bound(*world, config)),
      obstacles(*world, config),
      air(config.radio, stations(config),
          {.events = events,
           .positions = positions,
           .obstacles = obstacles,
           .observer = observers,
           .seed = config.seed,
           .ground = *config.world.ground}),
      interfaces(config, air,
                 {.events = events,
                  .outside = outside,
                  .observer = observers,
                  .break_off = [this] { broken_off = true; }}),
      movables(*world, config.control_period),
      watch({.events = events,
             .position = [this](hal::AgentId agent) -> std::optional<hal::Vec2> {
               if (!agents.at(agent)->is_present()) return std::nullopt;
               const BodyState& body = scene.body(agent, events.now());
               return hal::Vec2{body.x, body.y};
             },
             .charge = [this](hal::AgentId agent) -> std::optional<double> {
               const SimulatedMote& one = *agents.at(agent);
               if (!one.is_present() || one.supply() == nullptr) return std::nullopt;
               return one.supply()->battery().charge();
             },
             .look_every = config.world.step}),
      script(config.script, events, watch,
             [this](const ScriptedAction& action, std::size_t event) { act(action, event); }) {
  const Surroundings surroundings{events, *world, scene, observers, config};
  for (const AgentConfig& agent : config.agents) {
    auto& made = agents[agent.id];
    if (is_robot(agent)) {
      auto robot = std::make_unique<SimulatedRobot>(agent, air.sap(agent.id), surroundings, *this);
      if (robot->supply() != nullptr) fed_robots.push_back(robot.get());
      made = std::move(robot);
    } else {
      made = std::make_unique<SimulatedMote>(agent, air.sap(agent.id), surroundings, *this);
    }
  }
}

AgentView Simulation::State::view(hal::AgentId agent) {
  return {.agent = *agents.at(agent),
          .scene = scene,
          .positions = positions,
          .mac = air.sap(agent),
          .now = events.now()};
}

Simulation::Simulation(const SimulationConfig& config, const std::vector<Observer*>& observers) {
  expect_allocations(config.agents.size() * kBytesPerAgent);
  state_ = std::make_unique<State>(config, observers);
}

Simulation::~Simulation() = default;

void Simulation::add_observer(Observer& observer) { state_->observers.add(observer); }

void Simulation::set_sampler(Sampler& sampler) {
  state_->sampler = &sampler;
  state_->look_due = sampler.due();
}

void Simulation::connect_air(air::FrameSink& sink, air::FrameSource& source) {
  state_->interfaces.connect(sink, source);
}

void Simulation::connect_air(air::FrameSink& sink, air::HeldPrograms& programs) {
  state_->interfaces.connect(sink, programs);
}

hal::Time Simulation::now() const { return state_->events.now(); }

void Simulation::stop_at(hal::Time at) {
  state_->events.schedule(at, Rank::kProgram, kWorld, [] {});
}

void Simulation::arrive(const std::string& door, std::span<const std::uint8_t> bytes) {
  state_->interfaces.arrive(door, bytes);
}

void Simulation::repeat_arrivals(std::vector<OutsideArrival> arrivals) {
  state_->interfaces.repeat_arrivals(std::move(arrivals));
}

OutsideInput& Simulation::outside() { return state_->outside; }

void Simulation::note_arrival(const std::string& name, std::vector<std::uint8_t> bytes) {
  state_->observers.on_arrival({state_->events.now(), name, std::move(bytes)});
  state_->interfaces.note_repeated(name);
}

std::vector<hal::node::exchange::AgentOffer> Simulation::offers() const {
  std::vector<hal::node::exchange::AgentOffer> offers;
  for (const auto& [id, agent] : state_->agents)
    offers.push_back({.session = agent->core().session(), .program = agent->config().program});
  return offers;
}

std::vector<hal::node::exchange::AgentName> Simulation::directory() const {
  std::vector<hal::node::exchange::AgentName> names;
  for (const AgentConfig& agent : state_->config.agents) names.push_back({agent.id, agent.name});
  return names;
}

void Simulation::connect(std::shared_ptr<hal::node::exchange::ControllerPort> port,
                         const std::vector<hal::AgentId>& agents, const hal::Wants& wants) {
  for (const hal::AgentId agent : agents) {
    state_->agents.at(agent)->core().connect(wants);
    state_->wants[agent] = wants;
  }
  state_->controllers.connect(std::move(port), agents);
}

void Simulation::begin(std::optional<hal::Time> until) {
  for (const auto& [id, agent] : state_->agents) {
    BARAKA_CHECK(state_->controllers.is_connected(id) || agent->config().program.empty());
  }
  state_->until = until;
  state_->start();
}

Outcome Simulation::run(std::optional<hal::Time> until, Pace& pace) {
  State& s = *state_;
  begin(until);
  s.interfaces.start_programs();
  while (!s.result && !s.broken_off) {
    const auto next = s.events.next_time();
    if (!next || (until && *next > *until)) break;
    s.go_on(*next, pace);
  }
  if (s.error.empty()) {
    s.look_at_the_end(until);
    s.stop_controllers();
  }
  Outcome outcome = s.outcome();
  if (s.interfaces.holds_programs()) outcome.held_air = s.interfaces.summary();
  return outcome;
}

Outcome Simulation::follow(std::optional<hal::Time> until, FollowedClock& clock) {
  begin(until);
  RealTimeRun run(*state_);
  run.follow(clock);
  return end_of(run);
}

Outcome Simulation::repeat(std::optional<hal::Time> until, std::span<const Turn> turns, Pace& pace,
                           bool open_loop) {
  begin(until);
  RealTimeRun run(*state_);
  run.set_open_loop(open_loop);
  run.repeat(turns, pace);
  return end_of(run);
}

Outcome Simulation::end_of(RealTimeRun& run) {
  State& s = *state_;
  if (s.error.empty()) {
    s.look_at_the_end(s.until);
    run.stop();
  }
  Outcome outcome = s.outcome();
  outcome.exchanges = run.steps();
  outcome.real_time = run.summary();
  return outcome;
}

void Simulation::end(std::string result) { state_->end(std::move(result)); }

void Simulation::fail(std::string error) { state_->fail(std::move(error)); }

Outcome Simulation::broken_off_by(const std::string& error) {
  state_->broken_off = true;
  if (state_->error.empty()) state_->error = error;
  return state_->outcome();
}

BodyState Simulation::body(hal::AgentId agent) const {
  return state_->scene.body(agent, state_->events.now());
}

ContactCounts Simulation::contacts(hal::AgentId agent) const {
  if (!state_->world->has(agent)) return {};  // a station: it has no contacts
  const physics::Contacts& contacts = state_->world->contacts(agent);
  return {.wall_steps = contacts.walls.steps, .object_steps = contacts.bodies.steps};
}

std::optional<double> Simulation::read(const Quantity& quantity, hal::AgentId agent,
                                       std::size_t number) const {
  return quantity.read(state_->view(agent), number);
}

AgentUse Simulation::use(hal::AgentId agent) const {
  const AgentView view = state_->view(agent);
  const Supply* const supply = view.agent.supply();
  if (supply == nullptr) return {.radio = view.mac.use()};
  return {.radio = view.mac.use(), .energy = supply->battery().drawn(), .load = supply->load()};
}

bool Simulation::holds(std::size_t asked) const {
  return state_->watch.holds(state_->asked[asked]);
}

bool Simulation::has_held(std::size_t asked) const {
  return state_->watch.has_held(state_->asked[asked]);
}

const std::string& Simulation::state(hal::AgentId agent) const {
  return state_->agents.at(agent)->core().last_state();
}

}  // namespace sim::agents
