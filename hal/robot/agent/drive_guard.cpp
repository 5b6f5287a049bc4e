#include "hal/robot/agent/drive_guard.h"

#include <utility>

#include "hal/types/log.h"

namespace hal::robot::agent {

DriveGuard::DriveGuard(drivers::WheelDriver& wheels, platform::EventLoop& loop,
                       Duration command_timeout, std::string name)
    : wheels_(wheels), loop_(loop), command_timeout_(command_timeout), name_(std::move(name)) {}

DriveGuard::~DriveGuard() {
  loop_.cancel(timer_);
  wheels_.stop();
}

Result<void> DriveGuard::drive(const Twist2& body, Time as_of) {
  const auto result = drivers::limited(body, wheels_.kinematics(), wheels_.speed_limits());
  const Twist2& twist = result.twist;
  const bool moves = twist != Twist2{};
  if (moves && is_emergency_stopped()) {
    ++counts_.stopped;
    return fail(Errc::kNotAvailable, "the emergency stop is in force");
  }
  if (moves && !blind_because_.empty()) {
    ++counts_.blind;
    return fail(Errc::kNotAvailable, blind_because_);
  }
  if (result.saturated) ++counts_.limited;
  auto driven = wheels_.drive(twist, loop_.on_boot_clock(as_of));
  if (!driven) ++counts_.not_connected;
  // The driver must not repeat an older velocity after it refused this one.
  if (!driven) wheels_.stop();
  turning_ = driven.has_value() && moves;
  // Another thread may have requested the emergency stop since the check above.
  if (is_emergency_stopped()) halt();
  if (turning_ && timer_ == 0) watch();
  return driven;
}

Result<void> DriveGuard::drive_wheels(std::span<const double> speeds, Time as_of) {
  return drive(wheels_.kinematics().body_velocity(speeds), as_of);
}

void DriveGuard::feed(Time as_of) {
  fed_ = as_of;
  wheels_.keep(loop_.on_boot_clock(as_of));
}

/// Uses one timer that checks occasionally, instead of moving a timer with every answer.
void DriveGuard::watch() {
  timer_ = 0;
  if (!turning_) return;
  if (loop_.now() >= fed_ + command_timeout_) {
    ++counts_.silences;
    log::warning(loop_.now(), name_, "no answer for {} s: the wheels stop",
                 to_seconds(command_timeout_));
    return halt();
  }
  timer_ = loop_.schedule(fed_ + command_timeout_, [this] { watch(); });
}

void DriveGuard::halt() {
  wheels_.stop();
  turning_ = false;
}

void DriveGuard::set_blind(const std::string& because) {
  const bool saw = blind_because_.empty();
  blind_because_ = because;
  if (saw && !because.empty()) halt();
}

void DriveGuard::set_emergency_stop(bool stop, StopSource source) {
  const auto bit = static_cast<unsigned>(source);
  const unsigned before = stop ? stops_.fetch_or(bit) : stops_.fetch_and(~bit);
  const unsigned after = stop ? before | bit : before & ~bit;
  if (stop) wheels_.stop();
  if ((before == 0) == (after == 0)) return;
  loop_.post([this, stop] {
    if (stop) halt();
    if (stop) log::warning(loop_.now(), name_, "EMERGENCY STOP");
    if (!stop) log::info(loop_.now(), name_, "the emergency stop is released");
  });
}

}  // namespace hal::robot::agent
