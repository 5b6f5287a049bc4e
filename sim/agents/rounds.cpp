#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>
#include <vector>

#include "hal/types/log.h"
#include "sim/agents/simulated_robot.h"
#include "sim/agents/simulation_state.h"

namespace sim::agents {

using hal::node::exchange::Action;
using hal::node::exchange::ControllerFailed;
using hal::node::exchange::Event;

namespace {

/// Moves events into the order of time; those of equal time keep their order. Each is moved only
/// once, because events are large.
void move_by_time(std::vector<Event>& from, std::vector<Event>& to) {
  std::vector<std::pair<hal::Time, std::size_t>> order;
  order.reserve(from.size());
  for (const Event& event : from) order.emplace_back(event.time, order.size());
  std::sort(order.begin(), order.end());
  to.reserve(from.size());
  for (const auto& [time, index] : order) to.push_back(std::move(from[index]));
}

}  // namespace

void Simulation::State::on_state(hal::AgentId agent, const std::string& state) {
  hal::log::debug(events.now(), agents.at(agent)->name(), "state {}", state);
  for (const EndCondition& condition : config.ends) {
    if (condition.agent == agent && condition.state == state) on_end(condition);
  }
}

void Simulation::State::start() {
  observers.on_start(air.links());
  for (const auto& [id, agent] : agents) {
    if (!agent->config().is_present) kill(id);
    agent->start();
  }
  movables.start(events.now(), observers);
  if (std::ranges::any_of(config.agents, has_body) || !config.movables.empty()) {
    events.schedule(hal::Time{} + config.world.step, Rank::kPhysics, kWorld,
                    [this] { step_bodies(); });
  }
  for (const EndCondition& condition : config.ends) {
    if (condition.agent || condition.when) continue;
    events.schedule(hal::Time{} + condition.after, Rank::kScenario, kWorld,
                    [this, &condition] { end(condition.result); });
  }
  watch_conditions();
}

void Simulation::State::watch_conditions() {
  for (const EndCondition& condition : config.ends) {
    if (condition.when) watch.add(*condition.when, [this, &condition] { on_end(condition); });
  }
  for (const Condition& condition : config.asked) asked.push_back(watch.add(condition));
  if (!watch.empty()) observers.add(watch);
  watch.start();
  script.start();
}

void Simulation::State::on_end(const EndCondition& condition) {
  events.schedule(events.now() + condition.after, Rank::kScenario, kWorld,
                  [this, &condition] { end(condition.result); });
}

void Simulation::State::step_bodies() {
  world->step();
  for (SimulatedRobot* const robot : fed_robots) robot->feed_motors();
  movables.on_step(events.now(), observers);
  for (const hal::AgentId agent : std::exchange(displaced, {})) {
    air.displace(agent);
    observers.on_displaced(events.now(), agent);
  }
  let_arrive();
  for (const physics::LostBody& lost : world->lost_bodies().subspan(bodies_lost.size())) {
    const std::string& name =
        lost.movable ? config.movables[*lost.movable].name : agents.at(lost.agent)->name();
    hal::log::warning(events.now(), name, "{}", physics::name(lost.how));
    bodies_lost.push_back(
        fmt::format("{} {} at {:.9f} s", name, physics::name(lost.how), hal::to_seconds(lost.at)));
    if (!lost.movable) observers.on_body_lost(lost);
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
  const hal::Time last = last_instant(begin);
  while (!result && !broken_off) {
    const auto next = events.next_time();
    if (!next || *next > last) break;
    look_before(*next);
    events.run_next(std::min(last, look_due));
  }
}

void Simulation::State::look_until(hal::Time next) {
  while (look_due < next) {
    events.advance_to(look_due);
    sampler->look(look_due);
    look_due = sampler->due();
  }
}

void Simulation::State::look_at_the_end(std::optional<hal::Time> until_then) {
  const bool goes_on = !result && !broken_off && until_then;
  const hal::Time end = goes_on ? *until_then : events.now();
  look_before(end + hal::Duration{1});
  if (goes_on) events.advance_to(end);
  watch.look_at_the_end();
}

std::vector<Event>& Simulation::State::take_events() {
  taken.clear();
  taken_by_time.clear();
  waiting.take([this](hal::AgentId agent) { agents.at(agent)->core().take_events(taken); });
  std::ranges::move(std::exchange(farewells, {}), std::back_inserter(taken));
  // Already ordered by agent, and by cause for each agent; in a window of time, time comes first.
  const auto earlier = [](const Event& a, const Event& b) { return a.time < b.time; };
  if (std::is_sorted(taken.begin(), taken.end(), earlier)) return taken;
  move_by_time(taken, taken_by_time);
  return taken_by_time;
}

void Simulation::State::exchange(hal::Time window_end) {
  std::vector<Event>& all = take_events();
  if (all.empty() && !controllers.is_one_awaited()) return;
  Controllers::Round round = controllers.exchange(all, window_end);
  on_failures(round.failures);
  for (Controllers::Answer& answer : round.answers) {
    if (error.empty()) take_effect(std::move(answer));
  }
  // What controllers in the agents' networks have sent meanwhile.
  if (controllers.share_time()) interfaces.serve_outsiders(events.now());
}

bool Simulation::State::is_of_dead(hal::AgentId agent, hal::Time event_time) const {
  const auto died = died_at.find(agent);
  return died != died_at.end() && event_time < died->second;
}

void Simulation::State::take_effect(Controllers::Answer answer) {
  if (is_of_dead(answer.action.agent, answer.event_time)) return;
  if (const auto* failed = std::get_if<ControllerFailed>(&answer.action.what)) {
    return on_error(answer.action.agent, failed->text, answer.event_time);
  }
  if (config.controller_latency == hal::Duration::zero()) {
    apply(answer.action);
    return;
  }
  // A controller that waits by simulated time may answer later than that.
  const hal::Time at = std::max(answer.event_time + config.controller_latency, events.now());
  const hal::AgentId agent = answer.action.agent;
  const auto given = std::make_shared<Controllers::Answer>(std::move(answer));
  events.schedule(at, Rank::kAction, agent, [this, given] {
    if (!is_of_dead(given->action.agent, given->event_time)) apply(given->action);
  });
}

void Simulation::State::on_error(hal::AgentId agent, const std::string& text,
                                 hal::Time event_time) {
  fail(fmt::format("the controller of {} (process {}) failed at {:.9f} s: {}",
                   agents.at(agent)->name(), controllers.process_of(agent),
                   hal::to_seconds(event_time), text));
}

void Simulation::State::apply(const Action& action) {
  // The core counts and logs actions that it refuses.
  (void)agents.at(action.agent)->core().apply(action, events.now());
}

/// After the end, only actions without effect on the world count (is_word()).
void Simulation::State::apply_last(const Action& action) {
  const bool is_heard = std::ranges::find(dead, action.agent) == dead.end();
  if (is_heard && is_word(action)) apply(action);
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
      watch.forget_state(agent);
    }
  }
}

/// Controllers that the script killed are also told, so that their processes know that the run is
/// over; their replies are ignored.
void Simulation::State::stop_agents() {
  for (const auto& [id, agent] : agents) agent->core().stop();
  for (const hal::AgentId agent : dead) {
    Event stop;
    stop.agent = agent;
    stop.time = events.now();
    stop.what = hal::node::exchange::Stop{};
    farewells.push_back(std::move(stop));
  }
}

void Simulation::State::stop_controllers() {
  stop_agents();
  Controllers::Round round = controllers.exchange(take_events(), events.now());
  for (const Controllers::Failure& failure : round.failures) {
    hal::log::warning(events.now(), "run", "at the stop: {}", failure.error.message);
  }
  for (const std::string& line : controllers.complaints())
    hal::log::warning(events.now(), "run", "{}", line);
  for (const Controllers::Answer& answer : round.answers) apply_last(answer.action);
}

Outcome Simulation::State::outcome() const {
  const auto [kind, name] = !error.empty() ? std::pair(Outcome::Kind::kFailed, "failed")
                            : broken_off   ? std::pair(Outcome::Kind::kInterrupted, "interrupted")
                            : result       ? std::pair(Outcome::Kind::kEnded, result->c_str())
                                           : std::pair(Outcome::Kind::kUntil, "until");
  std::uint64_t refused = 0;
  for (const auto& [id, agent] : agents) refused += agent->core().refused();
  return {.kind = kind,
          .result = name,
          .error = error,
          .ended_at = events.now(),
          .events = events.executed(),
          .exchanges = controllers.exchanges(),
          .refused_actions = refused,
          .ode_messages = world->solver_messages(),
          .bodies_lost = bodies_lost};
}

/// Takes the inputs from outside that are due. @return whether there were any.
bool Simulation::State::take_outside(hal::Time now) {
  return outside.take(now,
                      [this](const OutsideArrival& arrival) { observers.on_arrival(arrival); });
}

/// At once where the run is slow, else after several instants: most runs have no outsiders.
void Simulation::State::serve_outsiders(hal::Time next) {
  constexpr unsigned kInstants = 64;
  if (instants_until_look > 0) {
    --instants_until_look;
    return;
  }
  instants_until_look = kInstants;
  interfaces.serve_outsiders(next);
}

void Simulation::State::go_on(hal::Time next, Pace& pace) {
  switch (pace.may_go_on(next, {events.now(), events.executed(), controllers.exchanges()})) {
    case Pace::Verdict::kBreakOff:
      broken_off = true;
      return;
    case Pace::Verdict::kAskAgain:
      instants_until_look = 0;
      interfaces.serve_due();
      return on_failures(controllers.find_dead());
    case Pace::Verdict::kGoOn:
      serve_outsiders(next);
      look_before(next);
      take_outside(next);
      work_off(next);
      if (!result && !broken_off) exchange(next + config.controller_latency);
  }
}

}  // namespace sim::agents
