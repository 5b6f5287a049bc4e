#include "sim/agents/real_time_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

#include "hal/types/log.h"

namespace sim::agents {
namespace {

using hal::node::exchange::Cause;
using hal::node::exchange::ControllerFailed;
using hal::node::exchange::Courier;
using hal::node::exchange::Event;

/// Controllers are served at least this often while the run catches up with the clock.
constexpr hal::Duration kLongestTurn = std::chrono::milliseconds{20};
/// The same with programs, whose frames wait meanwhile.
constexpr hal::Duration kLongestTurnWithPrograms = std::chrono::microseconds{500};

std::string_view plural(Cause cause) {
  switch (cause) {
    case Cause::kStart:
      return "starts";
    case Cause::kMessage:
      return "messages";
    case Cause::kTimer:
      return "timers";
    case Cause::kNotice:
      return "notices";
    case Cause::kLink:
      return "link changes";
    case Cause::kControl:
      return "control cycles";
    case Cause::kStop:
      return "stops";
  }
  return {};
}

}  // namespace

Simulation::RealTimeRun::RealTimeRun(State& state) : s_(state) {
  for (std::size_t i = 0; i < s_.controllers.ports(); ++i) {
    const std::size_t capacity = Courier::capacity_for(s_.controllers.agents_of(i).size());
    carried_.push_back({Courier(s_.controllers.port(i), capacity), false});
  }
}

void Simulation::RealTimeRun::follow(FollowedClock& clock) {
  s_.interfaces.follow(clock);
  hal::Time last{};
  while (!s_.result) {
    const auto next = next_stop(last);
    if (!next) return;
    if (!clock.wait(*next, descriptors(), progress())) {
      s_.broken_off = true;
      return;
    }
    if (s_.interfaces.is_connected()) s_.interfaces.take_frames(last);
    // Turns have distinct times, which makes them repeatable.
    last =
        std::max(std::min(clock.now(), *next + longest_turn()), last + std::chrono::nanoseconds{1});
    if (s_.until) last = std::min(last, *s_.until);
    take_arrivals_until(last - hal::Duration{1}, &clock);
    take_last_arrivals(last, clock);
    if (s_.result) return;
    attend(last);
    if (s_.interfaces.is_connected()) s_.interfaces.tell_room();
  }
}

/// Inputs without a time enter at the time of the turn, together with inputs that have that time:
/// as in a repetition, after the events of that time, and before the turn the events that they
/// caused at that time.
void Simulation::RealTimeRun::take_last_arrivals(hal::Time turn, FollowedClock& clock) {
  work_off_until(turn, &clock);
  if (s_.result || !s_.outside.has_due(turn)) return;
  take_arrivals_at(turn);
  work_off_until(turn, &clock);
}

/// The next time to wait for: the next event or input that has a time; nullopt at the end of the
/// run. While programs are connected, they may send until `until`.
std::optional<hal::Time> Simulation::RealTimeRun::next_stop(hal::Time last) {
  std::optional<hal::Time> next = s_.events.next_time();
  if (s_.until && (!next || *next > *s_.until)) {
    if (!s_.interfaces.is_connected() || last >= *s_.until) return std::nullopt;
    next = s_.until;
  }
  const auto due = s_.outside.next_due();
  return next && due ? std::min(*next, *due) : next;
}

hal::Duration Simulation::RealTimeRun::longest_turn() const {
  return s_.interfaces.is_connected() ? kLongestTurnWithPrograms : kLongestTurn;
}

void Simulation::RealTimeRun::repeat(std::span<const Turn> turns, Pace& pace) {
  for (const Turn& turn : turns) {
    if (s_.result || s_.broken_off) return;
    if (s_.until && turn.at > *s_.until) break;
    if (!may_go_on(pace, turn.at)) return;
    take_arrivals_until(turn.at, nullptr);
    work_off_until(turn.at, nullptr);
    if (s_.result) return;
    take_up(turn);
  }
  repeat_rest(pace);
}

/// Continues after the last turn.
void Simulation::RealTimeRun::repeat_rest(Pace& pace) {
  while (!s_.result) {
    std::optional<hal::Time> next = s_.events.next_time();
    const auto due = s_.outside.next_due();
    if (due && (!next || *due < *next)) next = due;
    if (!next || !s_.until || *next > *s_.until || !may_go_on(pace, *next)) return;
    take_arrivals_until(*next, nullptr);
    work_off_until(*next, nullptr);
  }
}

/// Takes each input after the events up to its time, and before a turn at that time.
void Simulation::RealTimeRun::take_arrivals_until(hal::Time target, FollowedClock* clock) {
  while (!s_.result) {
    const auto at = s_.outside.next_due();
    if (!at || *at > target) return;
    work_off_until(*at, clock);
    if (!s_.result) take_arrivals_at(*at);
  }
}

/// @pre the events up to `at` have run.
void Simulation::RealTimeRun::take_arrivals_at(hal::Time at) {
  s_.look_before(at);
  s_.events.advance_to(at);
  s_.take_outside(at);
}

bool Simulation::RealTimeRun::may_go_on(Pace& pace, hal::Time at) {
  Pace::Verdict verdict = Pace::Verdict::kAskAgain;
  while (verdict == Pace::Verdict::kAskAgain) verdict = pace.may_go_on(at, progress());
  s_.broken_off = verdict == Pace::Verdict::kBreakOff;
  return !s_.broken_off;
}

void Simulation::RealTimeRun::take_up(const Turn& turn) {
  if (turn.port >= carried_.size()) return s_.fail("the record is of other controllers");
  if (carried_[turn.port].dropped) return;
  if (!turn.replied && !turn.began) {
    return on_death(turn, {hal::Errc::kNotConnected, "a process of the record died"});
  }
  Courier& courier = carried_[turn.port].courier;
  Turn taken = turn;
  if (open_loop_) {
    taken.replied = turn.replied && !courier.is_idle();
    taken.began = turn.began && courier.has_waiting() && (taken.replied || courier.is_idle());
    if (!taken.replied && !taken.began) return;
  }
  auto brought = courier.repeat(taken.replied, taken.began);
  if (!brought) return on_death(taken, brought.error());
  take_in(taken, *brought);
}

void Simulation::RealTimeRun::work_off_until(hal::Time target, FollowedClock* clock) {
  while (!s_.result) {
    const auto instant = s_.events.next_time();
    if (!instant || *instant > target) return;
    s_.look_before(*instant);
    while (!s_.result && s_.events.next_time() == instant) s_.events.run_next();
    post(clock);
  }
}

void Simulation::RealTimeRun::post(FollowedClock* clock) {
  bool has_control = false;
  for (Event& event : s_.take_events()) {
    has_control = has_control || event.cause() == Cause::kControl;
    const std::size_t port = s_.controllers.port_of(event.agent);
    carried_[port].courier.post(std::move(event));
  }
  if (clock == nullptr || !has_control) return;
  const hal::Duration late = std::max(clock->now() - s_.events.now(), hal::Duration::zero());
  lateness_.add(late);
  counts_.overruns += late > s_.config.control_period ? 1 : 0;
}

void Simulation::RealTimeRun::attend(hal::Time now) {
  for (std::size_t i = 0; i < carried_.size() && !s_.result; ++i) {
    if (carried_[i].dropped) continue;
    auto brought = carried_[i].courier.attend();
    if (!brought) {
      on_death({now, i}, brought.error());
    } else if (brought->replied || brought->began) {
      take_in({now, i, brought->replied, brought->began}, *brought);
    }
    // As before each turn in a repetition.
    work_off_until(now, nullptr);
  }
}

void Simulation::RealTimeRun::take_in(const Turn& turn, const Courier::Turn& brought) {
  s_.look_before(turn.at);
  s_.events.advance_to(turn.at);
  s_.observers.on_turn(turn);
  hal::log::debug(turn.at, "exchange", "{}: {} actions took effect{}",
                  s_.controllers.port_name(turn.port), brought.answers.size(),
                  turn.began ? ", the next Step was handed over" : "");
  const bool stale = Courier::is_stale(brought, turn.at, s_.config.command_timeout);
  for (const hal::AgentId agent : brought.answered) {
    restart_watchdog(agent);
    if (stale) s_.agents.at(agent)->core().halt();
  }
  for (const Courier::Answer& answer : brought.answers) {
    if (s_.error.empty()) take_effect(answer, stale);
  }
  post(nullptr);
}

void Simulation::RealTimeRun::take_effect(const Courier::Answer& answer, bool stale) {
  const auto& [action, event_time] = answer;
  if (s_.is_of_dead(action.agent, event_time)) return;
  if (const auto* failed = std::get_if<ControllerFailed>(&action.what)) {
    return s_.on_error(action.agent, failed->text, event_time);
  }
  if (stale && drives(action)) return s_.agents.at(action.agent)->core().refuse(Courier::kStale);
  s_.apply(action);
}

/// Recorded as a turn without a reply and without a Step.
void Simulation::RealTimeRun::on_death(const Turn& turn, const hal::Error& error) {
  s_.look_before(turn.at);
  s_.events.advance_to(turn.at);
  s_.observers.on_turn({turn.at, turn.port});
  carried_[turn.port].dropped = true;
  s_.on_failures({{turn.port, error}});
}

/// Any reply is a sign of life: a controller need not repeat its command.
void Simulation::RealTimeRun::restart_watchdog(hal::AgentId agent) {
  if (!s_.agents.at(agent)->core().has_wheels()) return;
  EventQueue::EventId& watchdog = watchdogs_[agent];
  s_.events.cancel(watchdog);
  watchdog = s_.events.schedule(s_.events.now() + s_.config.command_timeout, Rank::kAction, agent,
                                [this, agent] {
                                  ++counts_.command_timeouts;
                                  s_.agents.at(agent)->core().halt();
                                });
}

void Simulation::RealTimeRun::stop() {
  finish_all();
  s_.stop_agents();
  post(nullptr);
  for (std::size_t i = 0; i < carried_.size(); ++i) {
    if (carried_[i].dropped || !carried_[i].courier.has_waiting()) continue;
    if (auto begun = carried_[i].courier.repeat(false, true); !begun) carried_[i].dropped = true;
  }
  finish_all();
}

void Simulation::RealTimeRun::finish_all() {
  for (Carried& carried : carried_) {
    if (carried.dropped) continue;
    auto brought = carried.courier.finish();
    if (!brought) {
      carried.dropped = true;
      hal::log::warning(s_.events.now(), "run", "at the stop: {}", brought.error().message);
      continue;
    }
    for (const Courier::Answer& answer : brought->answers) s_.apply_last(answer.action);
  }
}

std::vector<int> Simulation::RealTimeRun::descriptors() const {
  std::vector<int> all{s_.outside.descriptor()};
  if (s_.interfaces.is_connected()) all.push_back(s_.interfaces.descriptor());
  for (const Carried& carried : carried_) {
    if (carried.dropped) continue;
    const std::vector<int> some = carried.courier.descriptors();
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

std::uint64_t Simulation::RealTimeRun::steps() const {
  std::uint64_t steps = 0;
  for (const Carried& carried : carried_) steps += carried.courier.steps();
  return steps;
}

Progress Simulation::RealTimeRun::progress() const {
  return {s_.events.now(), s_.events.executed(), steps()};
}

RealTimeSummary Simulation::RealTimeRun::summary() const {
  RealTimeSummary summary = counts_;
  for (const Carried& carried : carried_) {
    summary.missed_cycles += carried.courier.losses().missed_cycles;
    for (const auto& [what, count] : carried.courier.losses().overflow) {
      summary.lost_events += count;
      summary.overflow.push_back(
          fmt::format("{}: {} {}", s_.agents.at(what.first)->name(), count, plural(what.second)));
    }
  }
  summary.jitter_median = lateness_.quantile(0.5);
  summary.jitter_p99 = lateness_.quantile(0.99);
  summary.jitter_max = lateness_.greatest();
  if (!s_.interfaces.empty()) summary.air = s_.interfaces.summary();
  return summary;
}

}  // namespace sim::agents
