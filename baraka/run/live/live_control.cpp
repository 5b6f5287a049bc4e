#include "baraka/run/live/live_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "hal/types/overloaded.h"
#include "sim/radio/mac/frame.h"

namespace baraka::run::live {
namespace {

using namespace std::chrono_literals;
using view::server::Break;
using view::server::Steps;

/// Within this time a paused run notices that it is resumed, that a process died, or Ctrl-C.
constexpr hal::Duration kSlice = 20ms;
/// A viewer's data are at most this old.
constexpr hal::Duration kRefresh = 500ms;
/// A viewer counts as present for this time after its last request.
constexpr hal::Duration kLooking = 2s;
constexpr std::size_t kMostBreaks = 100;

tl::unexpected<hal::Error> refusal(std::string why) {
  return hal::fail(hal::Errc::kInvalidArgument, std::move(why));
}

}  // namespace

LiveControl::LiveControl(const sim::agents::SimulationConfig& config,
                         const sim::agents::Simulation& simulation, hal::Clock& clock,
                         Settings settings)
    : config_(config), simulation_(simulation), clock_(clock), settings_(std::move(settings)) {
  now_.can_hold = settings_.lockstep;
  now_.paused = settings_.paused && settings_.lockstep;
  now_.speed = settings_.max_speed;
  paced_since_ = clock_.now();
}

std::string LiveControl::name(hal::AgentId agent) const {
  const auto found = std::ranges::find(config_.agents, agent, &sim::agents::AgentConfig::id);
  return found == config_.agents.end() ? fmt::format("{}", agent.value) : found->name;
}

hal::Result<std::int64_t> LiveControl::act(const view::server::Command& command) {
  if (const auto* drive = std::get_if<view::server::DriveByHand>(&command)) {
    const hal::AgentId agent{drive->agent};
    if (settings_.drive && settings_.drive(agent, {drive->vx, drive->vy, drive->omega})) return 0;
    return refusal(
        fmt::format("{} cannot be driven by hand: its controller is not teleop", name(agent)));
  }
  if (!settings_.lockstep) {
    return refusal("this run keeps real time: it cannot be paused, stepped or slowed");
  }
  const std::lock_guard lock(mutex_);
  return std::visit(
      hal::Overloaded{
          [&](const view::server::Pause&) -> hal::Result<std::int64_t> {
            pause("");
            return 0;
          },
          [&](const view::server::Resume&) -> hal::Result<std::int64_t> {
            stepping_.reset();
            now_.paused = false;
            now_.stopped_by.reset();
            restart_pace();
            return 0;
          },
          [&](const Steps& steps) { return start(steps); },
          [&](const view::server::Speed& speed) -> hal::Result<std::int64_t> {
            if (!std::isfinite(speed.factor) || speed.factor < 0) {
              return refusal("a speed is 0 or more");
            }
            now_.speed = speed.factor;
            restart_pace();
            return 0;
          },
          [&](const Break& at) { return add(at); },
          [&](const view::server::Clear& clear) -> hal::Result<std::int64_t> {
            if (breaks_.erase(clear.id) > 0) return 0;
            return refusal(fmt::format("no break {}", clear.id));
          },
          [&](const view::server::DriveByHand&) -> hal::Result<std::int64_t> { return 0; },
      },
      command);
}

hal::Result<std::int64_t> LiveControl::start(const Steps& steps) {
  if (now_.ended) return refusal("the run has ended");
  stepping_ = Stepping{.steps = steps};
  now_.paused = false;
  now_.stopped_by.reset();
  restart_pace();
  return 0;
}

hal::Result<std::int64_t> LiveControl::add(const Break& at) {
  if (breaks_.size() >= kMostBreaks) {
    return refusal(fmt::format("there are {} breaks already", kMostBreaks));
  }
  if (at.on == Break::On::kTime && hal::Time{hal::Duration{at.at}} < next_) {
    return refusal("that time has passed");
  }
  breaks_[++last_break_] = at;
  return last_break_;
}

view::server::Clock::Now LiveControl::now() const {
  const std::lock_guard lock(mutex_);
  asked_at_ = clock_.now();
  return now_;
}

void LiveControl::keep() const {
  const std::lock_guard lock(mutex_);
  kept_at_ = clock_.now();
}

bool LiveControl::watched_within(hal::Duration time) const {
  const std::lock_guard lock(mutex_);
  const hal::Time now = clock_.now();
  const auto is_recent = [&](const std::optional<hal::Time>& at) { return at && now - *at < time; };
  return is_recent(asked_at_) || is_recent(kept_at_);
}

void LiveControl::restart_pace() {
  paced_from_ = next_;
  paced_since_ = clock_.now();
}

void LiveControl::pause(std::string why) {
  if (now_.ended) return;
  stepping_.reset();
  now_.paused = true;
  if (!why.empty()) now_.stopped_by = std::move(why);
}

/// Commits the record before advancing the clock, so that all data up to the clock's time exist.
void LiveControl::refresh() {
  settings_.commit();
  committed_at_ = clock_.now();
  const std::lock_guard lock(mutex_);
  now_.until = now_.now;
}

void LiveControl::reach(hal::Time next) {
  next_ = next;
  // All events before `next` have happened.
  now_.now = std::max<std::int64_t>(hal::to_ns(next) - 1, 0);
  const auto is_over = [next](const auto& one) {
    return one.second.on == Break::On::kTime && hal::Time{hal::Duration{one.second.at}} <= next;
  };
  const auto first = std::ranges::find_if(breaks_, is_over);
  if (first == breaks_.end()) return;
  pause(fmt::format("time {:.9f} s", static_cast<double>(first->second.at) * 1e-9));
  std::erase_if(breaks_, is_over);
}

bool LiveControl::is_to_refresh(hal::Time wall) const {
  if (now_.until >= now_.now) return false;
  if (now_.paused && settings_.lockstep) return true;
  return asked_at_ && wall - *asked_at_ < kLooking && wall - committed_at_ >= kRefresh;
}

std::optional<hal::Duration> LiveControl::wait_left(hal::Time wall) const {
  if (!settings_.lockstep) return std::nullopt;
  if (now_.paused) return kSlice;
  if (now_.speed <= 0) return std::nullopt;
  constexpr double kWorthSleeping = 1e-3;  // s
  const double left =
      hal::to_seconds(next_ - paced_from_) / now_.speed - hal::to_seconds(wall - paced_since_);
  if (left < kWorthSleeping) return std::nullopt;
  return std::min<hal::Duration>(hal::from_seconds(left), kSlice);
}

std::optional<hal::Duration> LiveControl::hold(hal::Time next) {
  const hal::Time wall = clock_.now();
  bool is_stale = false;
  std::optional<hal::Duration> wait;
  {
    const std::lock_guard lock(mutex_);
    reach(next);
    // The time before the first instant, for example for starting controllers, does not count.
    if (!std::exchange(has_begun_, true)) restart_pace();
    is_stale = is_to_refresh(wall);
    wait = wait_left(wall);
  }
  if (is_stale) refresh();
  return wait;
}

void LiveControl::end(hal::Time at, const std::string& result) {
  const std::lock_guard lock(mutex_);
  now_.now = now_.until = hal::to_ns(at);
  now_.paused = false;
  now_.ended = true;
  now_.result = result;
}

void LiveControl::count(Steps::Of what, hal::Time at, hal::AgentId agent) {
  const std::lock_guard lock(mutex_);
  if (!stepping_ || stepping_->steps.of != what) return;
  if (stepping_->steps.agent && *stepping_->steps.agent != agent.value) return;
  if (what == Steps::Of::kCycle && std::exchange(stepping_->last, at) == at) return;
  if (--stepping_->steps.count <= 0) pause("");
}

bool LiveControl::is_watched(Break::On on) const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(breaks_, [on](const auto& one) { return one.second.on == on; });
}

void LiveControl::pause_if(Break::On on, hal::AgentId agent, std::string_view text,
                           const std::function<std::string()>& why) {
  const std::lock_guard lock(mutex_);
  for (const auto& [id, one] : breaks_) {
    if (one.on != on || (one.agent && *one.agent != agent.value)) continue;
    const std::string& wanted = on == Break::On::kState ? one.state : one.topic;
    if (!wanted.empty() && wanted != text) continue;
    pause(why());
    return;
  }
}

void LiveControl::on_cycle(hal::Time at, hal::AgentId agent) {
  count(Steps::Of::kCycle, at, agent);
  if (!is_watched(Break::On::kContact)) {
    contacts_.clear();
    return;
  }
  const sim::agents::ContactCounts now = simulation_.contacts(agent);
  const auto [then, is_new] = contacts_.try_emplace(agent, now);
  const bool touches =
      now.wall_steps > then->second.wall_steps || now.object_steps > then->second.object_steps;
  then->second = now;
  if (is_new || !touches) return;
  pause_if(Break::On::kContact, agent, "", [&] { return name(agent) + " touches something"; });
}

void LiveControl::on_frame_start(hal::Time at, const sim::radio::Frame& frame) {
  count(Steps::Of::kFrame, at, frame.transmitter);
}

void LiveControl::on_reception(hal::Time, const sim::radio::Frame& frame, hal::AgentId receiver,
                               hal::Verdict verdict, double) {
  if (verdict != hal::Verdict::kCollision) return;
  pause_if(Break::On::kCollision, receiver, "", [&] {
    return fmt::format("a collision at {} of a frame from {}", name(receiver),
                       name(frame.transmitter));
  });
}

void LiveControl::on_message_sent(hal::Time at, const hal::Message& message) {
  count(Steps::Of::kEvent, at, message.source);
  pause_if(Break::On::kMessage, message.source, message.topic, [&] {
    return fmt::format("{} sent message {} of {}", name(message.source), message.id, message.topic);
  });
}

void LiveControl::on_message_delivered(hal::Time at, hal::AgentId receiver, const hal::Message&,
                                       int) {
  count(Steps::Of::kEvent, at, receiver);
}

void LiveControl::on_message_end(hal::Time, hal::AgentId at_node, hal::AgentId sender,
                                 hal::MessageId id, hal::Verdict verdict) {
  if (verdict == hal::Verdict::kDelivered) return;
  pause_if(Break::On::kLoss, sender, "", [&] {
    return fmt::format("message {} of {} was lost at {}: {}", id, name(sender), name(at_node),
                       hal::name(verdict));
  });
}

void LiveControl::on_state(hal::Time at, hal::AgentId agent, std::string_view state) {
  count(Steps::Of::kEvent, at, agent);
  pause_if(Break::On::kState, agent, state,
           [&] { return fmt::format("{} entered {}", name(agent), state); });
}

}  // namespace baraka::run::live
