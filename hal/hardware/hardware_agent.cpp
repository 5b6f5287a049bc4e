#include "hal/hardware/hardware_agent.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "hal/types/check.h"
#include "hal/types/log.h"

namespace hal::hardware {

using exchange::Action;
using exchange::ActionKind;
using exchange::Cause;
using exchange::Courier;
using exchange::Event;

HardwareAgent::HardwareAgent(const RobotFile& file, Surroundings surroundings)
    : file_(file),
      surroundings_(surroundings),
      loop_(surroundings.loop),
      sampler_(file, surroundings_.devices),
      sensor_watch_(file),
      router_(file.address, file.routing, {file.seed, file.name},
              {.link = surroundings.link,
               .timers = surroundings.loop,
               .application = *this,
               .observer = *this}) {
  if (WheelDriver* wheels = surroundings.devices.wheels) {
    guard_.emplace(*wheels, loop_, file.command_timeout, file.name);
  }
  surroundings.link.attach([this](const routing::Reception& reception, auto frame) {
    router_.on_frame(reception, frame);
  });
  schedule_cycle(loop_.now());
}

HardwareAgent::~HardwareAgent() {
  let_go();
  loop_.cancel(cycle_);
  surroundings_.link.attach({});
}

std::vector<exchange::AgentOffer> HardwareAgent::offers() const {
  if (courier_) return {};  // driven by somebody in this process
  return {offer_of(file_, surroundings_.devices)};
}

void HardwareAgent::connect(std::shared_ptr<exchange::ControllerPort> port,
                            const std::vector<AgentId>& agents, const Wants& wants) {
  BARAKA_CHECK(!courier_ && agents == std::vector{file_.address});
  courier_.emplace(std::move(port));
  for (const int descriptor : courier_->descriptors()) {
    if (descriptor >= 0) watches_.push_back(loop_.watch(descriptor, [this] { attend(); }));
  }
  ++counts_.controllers;
  sampler_.set_wants(wants);
  network_.start_anew(wants);
  look_at_sensors();
  log::info(loop_.now(), file_.name, "driven by process '{}'", courier_->name());
  post(event(Cause::kStart));
}

void HardwareAgent::disconnect(const std::vector<AgentId>& agents) {
  if (std::ranges::find(agents, file_.address) != agents.end()) let_go();
}

/// Wheels first: whatever else there is to be done, they must stand.
void HardwareAgent::let_go() {
  if (guard_) guard_->halt();
  if (!courier_) return;
  log::info(loop_.now(), file_.name, "no longer driven by process '{}'", courier_->name());
  for (const EventLoop::Watch watch : std::exchange(watches_, {})) loop_.unwatch(watch);
  loop_.cancel(std::exchange(attending_, 0));
  for (const auto& [id, timer] : controller_timers_) loop_.cancel(timer);
  controller_timers_.clear();
  sent_.clear();
  topics_ = {};
  counts_ = counts();
  courier_.reset();
  network_.start_anew({});
  sampler_.set_wants({});
}

void HardwareAgent::set_emergency_stop(bool stop, StopSource source) {
  if (guard_) guard_->set_emergency_stop(stop, source);
}

void HardwareAgent::stop() {
  if (guard_) guard_->halt();
  if (std::exchange(stopping_, true) || !courier_) return;
  courier_->post(event(Cause::kStop));
  attend();
}

void HardwareAgent::schedule_cycle(Time at) {
  cycle_ = loop_.schedule(at, [this, at] { on_cycle(at); });
}

/// Cycles keep to their grid; those that the loop came too late for are left out.
void HardwareAgent::on_cycle(Time due) {
  const Duration late = loop_.now() - due;
  counts_.latest_cycle = std::max(counts_.latest_cycle, late);
  const auto left_out = late / file_.control_period;
  counts_.overruns += static_cast<std::uint64_t>(left_out);
  schedule_cycle(due + (left_out + 1) * file_.control_period);
  look_at_sensors();
  observe();
  if (!courier_ || stopping_) return;
  Event control = event(Cause::kControl);
  control.readings = sampler_.take(BootClock::now());
  post(std::move(control));
}

std::vector<SilentDevice> HardwareAgent::silent() const {
  std::vector<SilentDevice> silent = sampler_.silent(BootClock::now());
  if (std::string trouble = surroundings_.link.trouble(); !trouble.empty()) {
    silent.push_back({"radio", std::move(trouble), false});
  }
  return silent;
}

void HardwareAgent::look_at_sensors() {
  const std::string because = sensor_watch_.look(loop_.now(), sampler_.silent(BootClock::now()));
  if (guard_) guard_->set_blind(because);
}

void HardwareAgent::observe() {
  AgentObserver& observer = surroundings_.observer;
  const auto& [wheels, infrared, source] = surroundings_.devices;
  const Time now = loop_.now();
  observer.on_cycle(now);
  if (sampler_.has_pose()) {
    if (const auto pose = sampler_.pose(BootClock::now())) observer.on_pose(now, *pose);
  }
  if (wheels != nullptr) {
    if (const auto state = wheels->state()) observer.on_odometry(now, state->pose, state->twist);
  }
  if (infrared != nullptr) {
    if (const auto readings = infrared->latest()) observer.on_ranges(now, readings->metres);
  }
}

Event HardwareAgent::event(Cause cause) {
  Event event;
  event.agent = file_.address;
  event.time = loop_.now();
  event.cause = cause;
  network_.tell(event);
  return event;
}

void HardwareAgent::post(Event event) {
  if (!courier_ || stopping_) return;
  ++counts_.events;
  courier_->post(std::move(event));
  attend_soon();
}

/// After what else is due now: events of one moment travel together.
void HardwareAgent::attend_soon() {
  if (attending_ != 0) return;
  attending_ = loop_.schedule(loop_.now(), [this] {
    attending_ = 0;
    attend();
  });
}

void HardwareAgent::attend() {
  if (!courier_) return;
  const auto turn = courier_->attend();
  if (turn) return take_in(*turn);
  log::warning(loop_.now(), file_.name, "{}", turn.error().message);
  let_go();
}

void HardwareAgent::take_in(const Courier::Turn& turn) {
  answered_at_ =
      loop_.now();  // Whatever holds up this thread from here on makes the answers older.
  const bool stale = Courier::is_stale(turn, answered_at_, file_.command_timeout);
  if (guard_ && stale) guard_->halt();
  if (guard_ && turn.replied && !stale) guard_->feed(answered_at_);
  counts_.refused_actions += turn.refused;
  for (const Courier::Answer& answer : turn.answers) {
    if (!courier_) break;
    if (stale && drives(answer.action)) {
      refuse(Courier::kStale);
    } else {
      apply(answer.action);
    }
  }
  // In process the answer is there already, and no descriptor will tell.
  if (turn.began && watches_.empty()) attend_soon();
  const bool is_last = stopping_ && courier_ && courier_->is_idle() && !courier_->has_waiting();
  if (is_last) let_go();
}

void HardwareAgent::apply(const Action& action) {
  const bool is_word = action.kind == ActionKind::kState || action.kind == ActionKind::kLog;
  if (stopping_ && !is_word) return;
  ++counts_.actions;
  if (const auto done = take_effect(action); !done) refuse(done.error().message);
}

void HardwareAgent::refuse(const std::string& why) {
  ++counts_.refused_actions;
  if (const auto line = refusals_.take(loop_.now(), why)) {
    log::warning(loop_.now(), file_.name, "action refused: {}", *line);
  }
}

Result<void> HardwareAgent::take_effect(const Action& action) {
  switch (action.kind) {
    case ActionKind::kDriveBody:
    case ActionKind::kDriveWheels:
      return drive(action);
    case ActionKind::kSend:
      return send(action);
    case ActionKind::kInvalidate:
      router_.invalidate(action.topic, action.destination);
      break;
    case ActionKind::kTimer:
      set_timer(action);
      break;
    case ActionKind::kRadio:
      surroundings_.link.set_radio(action.radio_on);
      break;
    case ActionKind::kState:
      log::info(loop_.now(), file_.name, "state {}", action.text);
      surroundings_.observer.on_state(loop_.now(), action.text);
      break;
    case ActionKind::kLog:
      log::write(action.level, loop_.now(), file_.name + "/controller", action.text);
      break;
    case ActionKind::kError:
      end_with_error(action.text);
      break;
  }
  return {};
}

Result<void> HardwareAgent::drive(const Action& action) {
  if (!guard_) return fail(Errc::kInvalidArgument, "drive: the agent has no wheels");
  if (action.kind == ActionKind::kDriveWheels)
    return guard_->drive_wheels(action.wheel_speeds, answered_at_);
  return guard_->drive(action.twist, answered_at_);
}

Result<void> HardwareAgent::send(const Action& action) {
  std::string mistake = mistake_in_message(action, file_.address);
  if (!mistake.empty()) return fail(Errc::kInvalidArgument, std::move(mistake));
  if (auto admitted = topics_.admit(action.topic); !admitted) return admitted;
  sent_[++last_message_] = action.message_id;
  router_.send({.source = file_.address,
                .destination = action.destination,
                .id = last_message_,
                .topic = action.topic,
                .payload = action.payload});
  return {};
}

void HardwareAgent::set_timer(const Action& action) {
  EventLoop::Handle& pending = controller_timers_[action.timer];
  loop_.cancel(pending);
  pending = loop_.schedule(action.at, [this, timer = action.timer] {
    Event due = event(Cause::kTimer);
    due.timer = timer;
    post(std::move(due));
  });
}

/// The controller threw. STOP tells its process that this agent is done with it.
void HardwareAgent::end_with_error(const std::string& text) {
  log::write(log::Level::kError, loop_.now(), file_.name, "the controller failed: " + text);
  if (guard_) guard_->halt();
  courier_->post(event(Cause::kStop));
  attend_soon();
}

void HardwareAgent::on_message(Message message) {
  Event received = event(Cause::kMessage);
  received.message = std::move(message);
  post(std::move(received));
}

void HardwareAgent::on_fate(MessageId id, Fate fate) {
  surroundings_.observer.on_fate(loop_.now(), id, fate);
  const auto sent = sent_.extract(id);
  if (sent.empty()) return;  // of a controller that is gone
  Event notice = event(Cause::kNotice);
  notice.noticed = sent.mapped();
  notice.fate = fate;
  post(std::move(notice));
}

void HardwareAgent::on_route_change(const RouteChange& change) {
  surroundings_.observer.on_route_change(loop_.now(), change);
  network_.on_route_change(change);
}

void HardwareAgent::on_neighbour(const Neighbour& neighbour) {
  if (network_.on_neighbour(neighbour)) post(event(Cause::kLink));
}

void HardwareAgent::on_neighbour_lost(AgentId neighbour) {
  if (network_.on_neighbour_lost(neighbour)) post(event(Cause::kLink));
}

AgentCounts HardwareAgent::counts() const {
  AgentCounts counts = counts_;
  if (!courier_) return counts;
  counts.steps += courier_->steps();
  counts.missed_cycles += courier_->losses().missed_cycles;
  for (const auto& [what, count] : courier_->losses().overflow) counts.overflow += count;
  return counts;
}

std::string mistake_in_message(const Action& action, AgentId self) {
  if (action.topic.empty() || action.topic.size() > kMaxTopic) {
    return fmt::format("send: topic of {} bytes; 1 to {} are allowed", action.topic.size(),
                       kMaxTopic);
  }
  if (action.payload.size() > kMaxPayload) {
    return fmt::format("send: payload of {} bytes; up to {} are allowed", action.payload.size(),
                       kMaxPayload);
  }
  if (action.destination == self || action.destination == AgentId{}) {
    return fmt::format("send: to agent {}, which is no other agent", action.destination.value);
  }
  return {};
}

}  // namespace hal::hardware
