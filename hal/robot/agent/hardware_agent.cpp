#include "hal/robot/agent/hardware_agent.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "hal/types/check.h"
#include "hal/types/log.h"

namespace hal::robot::agent {

using node::exchange::Action;
using node::exchange::Courier;

HardwareAgent::HardwareAgent(const RobotFile& file, Surroundings surroundings)
    : file_(file),
      surroundings_(surroundings),
      loop_(surroundings.loop),
      guard_([this]() -> std::optional<DriveGuard> {
        drivers::WheelDriver* wheels = surroundings_.devices.wheels;
        if (wheels == nullptr) return std::nullopt;
        return std::optional<DriveGuard>(std::in_place, *wheels, loop_, file_.command_timeout,
                                         file_.name);
      }()),
      sampler_(file, surroundings_.devices),
      sensor_watch_(file),
      core_(sampler_.offer().session, file.routing,
            {.timers = surroundings.loop,
             .link = surroundings.link,
             .drive = guard_ ? &*guard_ : nullptr,
             .sensors = sampler_,
             .observer = surroundings.observer,
             .listener = *this}) {
  surroundings.link.attach([this](const node::routing::Reception& reception, auto frame) {
    core_.router().on_frame(reception, frame);
  });
  schedule_cycle(loop_.now());
}

HardwareAgent::~HardwareAgent() {
  let_go();
  loop_.cancel(cycle_);
  surroundings_.link.attach({});
}

std::vector<node::exchange::AgentOffer> HardwareAgent::offers() const {
  if (courier_) return {};  // a process drives it already
  return {sampler_.offer()};
}

std::vector<node::exchange::AgentName> HardwareAgent::directory() const {
  std::vector<node::exchange::AgentName> known{{file_.address, file_.name}};
  for (const Landmark& landmark : file_.localisation.map) {
    if (landmark.agent != file_.address) known.push_back({landmark.agent, landmark.name});
  }
  return known;
}

void HardwareAgent::connect(std::shared_ptr<node::exchange::ControllerPort> port,
                            const std::vector<AgentId>& agents, const Wants& wants) {
  BARAKA_CHECK(!courier_ && agents == std::vector{file_.address});
  courier_.emplace(std::move(port));
  for (const int descriptor : courier_->descriptors()) {
    if (descriptor >= 0) watches_.push_back(loop_.watch(descriptor, [this] { attend(); }));
  }
  ++counts_.controllers;
  sampler_.set_wants(wants);
  look_at_sensors();
  log::info(loop_.now(), file_.name, "driven by process '{}'", courier_->name());
  core_.connect(wants);
  core_.start();
}

void HardwareAgent::disconnect(const std::vector<AgentId>& agents) {
  if (std::ranges::find(agents, file_.address) != agents.end()) let_go();
}

/// Stops the wheels before anything else.
void HardwareAgent::let_go() {
  core_.halt();
  if (!courier_) return;
  log::info(loop_.now(), file_.name, "no longer driven by process '{}'", courier_->name());
  for (const platform::EventLoop::Watch watch : std::exchange(watches_, {})) loop_.unwatch(watch);
  loop_.cancel(std::exchange(attending_, 0));
  core_.disconnect();
  counts_ = counts();
  courier_.reset();
  sampler_.set_wants({});
}

void HardwareAgent::set_emergency_stop(bool stop, StopSource source) {
  if (guard_) guard_->set_emergency_stop(stop, source);
}

void HardwareAgent::stop() {
  core_.halt();
  if (std::exchange(stopping_, true) || !courier_) return;
  core_.stop();
  attend();
}

void HardwareAgent::schedule_cycle(Time at) {
  cycle_ = loop_.schedule(at, [this, at] { on_cycle(at); });
}

/// Cycles keep their period; those that are due before the loop runs again are skipped.
void HardwareAgent::on_cycle(Time due) {
  const Duration late = loop_.now() - due;
  counts_.latest_cycle = std::max(counts_.latest_cycle, late);
  const auto left_out = late / file_.control_period;
  counts_.overruns += static_cast<std::uint64_t>(left_out);
  schedule_cycle(due + (left_out + 1) * file_.control_period);
  look_at_sensors();
  if (sampler_.has_pose()) {
    if (const auto pose = sampler_.pose(platform::BootClock::now())) {
      surroundings_.observer.on_pose(loop_.now(), file_.address, *pose);
    }
  }
  core_.control();
}

std::vector<SilentDevice> HardwareAgent::silent() const {
  std::vector<SilentDevice> silent = sampler_.silent(platform::BootClock::now());
  if (std::string trouble = surroundings_.link.trouble(); !trouble.empty()) {
    silent.push_back({"radio", std::move(trouble), false});
  }
  return silent;
}

void HardwareAgent::look_at_sensors() {
  const std::string because =
      sensor_watch_.look(loop_.now(), sampler_.silent(platform::BootClock::now()));
  if (guard_) guard_->set_blind(because);
}

void HardwareAgent::on_inbox(AgentId) { attend_soon(); }

void HardwareAgent::on_state(AgentId, const std::string& state) {
  log::info(loop_.now(), file_.name, "state {}", state);
}

/// Schedules attend() after everything else that is due now, so that simultaneous events travel
/// together.
void HardwareAgent::attend_soon() {
  if (attending_ != 0) return;
  attending_ = loop_.schedule(loop_.now(), [this] {
    attending_ = 0;
    attend();
  });
}

void HardwareAgent::attend() {
  if (!courier_) return;
  for (node::exchange::Event& event : core_.take_events()) {
    ++counts_.events;
    courier_->post(std::move(event));
  }
  const auto turn = courier_->attend();
  if (turn) return take_in(*turn);
  log::warning(loop_.now(), file_.name, "{}", turn.error().message);
  let_go();
}

void HardwareAgent::take_in(const Courier::Turn& turn) {
  // Any later delay in this thread makes the answers older.
  answered_at_ = loop_.now();
  const bool stale = Courier::is_stale(turn, answered_at_, file_.command_timeout);
  if (stale) core_.halt();
  if (guard_ && turn.replied && !stale) guard_->feed(answered_at_);
  for (const Courier::Answer& answer : turn.answers) {
    if (!courier_) break;
    take_effect(answer.action, stale);
  }
  // A controller in this process has answered already, and there is no descriptor to signal that.
  if (turn.began && watches_.empty()) attend_soon();
  const bool is_last = stopping_ && courier_ && courier_->is_idle() && !courier_->has_waiting();
  if (is_last) let_go();
}

void HardwareAgent::take_effect(const Action& action, bool stale) {
  if (stale && drives(action)) return core_.refuse(Courier::kStale);
  ++counts_.actions;
  if (const auto* failed = std::get_if<node::exchange::ControllerFailed>(&action.what))
    return end_with_error(failed->text);
  (void)core_.apply(action, answered_at_);  // counts and logs refusals itself
}

/// The controller threw an exception. STOP tells its process that this agent is finished with it.
void HardwareAgent::end_with_error(const std::string& text) {
  if (stopping_) return;
  log::write(log::Level::kError, loop_.now(), file_.name, "the controller failed: " + text);
  core_.halt();
  core_.stop();
}

AgentCounts HardwareAgent::counts() const {
  AgentCounts counts = counts_;
  counts.refused_actions = core_.refused();
  if (!courier_) return counts;
  counts.steps += courier_->steps();
  counts.missed_cycles += courier_->losses().missed_cycles;
  for (const auto& [what, count] : courier_->losses().overflow) counts.overflow += count;
  return counts;
}

}  // namespace hal::robot::agent
