#include "hal/robot/drivers/threaded_wheels.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace hal::robot::drivers {

ThreadedWheels::ThreadedWheels(std::unique_ptr<WheelDevice> device, const Setup& setup)
    : WheelDriver(setup.kinematics, setup.limits),
      device_(std::move(device)),
      command_(setup.command_timeout),
      thread_(*this, setup.rules) {}

ThreadedWheels::~ThreadedWheels() {
  stop();
  thread_.finish();
}

Result<void> ThreadedWheels::drive(const Twist2& body, platform::BootTime as_of) {
  if (!std::isfinite(body.vx) || !std::isfinite(body.vy) || !std::isfinite(body.omega)) {
    return fail(Errc::kInvalidArgument,
                fmt::format("velocity ({}, {}, {}): must be finite", body.vx, body.vy, body.omega));
  }
  if (const std::string trouble = thread_.trouble(); !trouble.empty()) {
    stop();  // otherwise the old velocity would be repeated after a reconnection
    return fail(Errc::kNotConnected, "wheels: " + trouble);
  }
  command_.set(body, as_of);
  thread_.wake();
  return {};
}

void ThreadedWheels::stop() {
  command_.stop();
  thread_.wake();
}

Result<void> ThreadedWheels::stop_and_wait(Duration at_most) {
  const std::uint64_t number = command_.stop();
  thread_.wake();
  if (const std::string trouble = thread_.trouble(); !trouble.empty()) {
    return fail(Errc::kNotConnected, "wheels: " + trouble);
  }
  if (command_.wait_for(number, at_most)) return {};
  return fail(
      Errc::kTimeout,
      fmt::format("wheels: the device has not confirmed to stop within {} s", to_seconds(at_most)));
}

platform::DeviceCounts ThreadedWheels::counts() const {
  platform::DeviceCounts counts = thread_.counts();
  counts.bad_answers += device_->passed_over();
  return counts;
}

Result<void> ThreadedWheels::connect() {
  // A velocity that was set while disconnected must not move the robot now.
  command_.stop();
  return device_->connect();
}

Result<void> ThreadedWheels::work() {
  const VelocityCommand::Numbered command = command_.current();
  auto sent = device_->send(command.velocity);
  const bool shall_stand = command_.current().velocity.at(platform::BootClock::now()) == Twist2{};
  if (sent && sent->body != Twist2{} && shall_stand) sent = device_->send({});
  if (!sent) return tl::unexpected<Error>(sent.error());
  if (sent->confirmed) command_.confirm(command.number);
  return {};
}

void ThreadedWheels::leave() {
  // If this fails, the device stops its wheels itself.
  (void)device_->send({});
}

}  // namespace hal::robot::drivers
