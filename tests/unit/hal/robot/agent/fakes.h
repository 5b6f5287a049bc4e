#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal/robot/agent/hardware_agent.h"
#include "tests/support/scripted_port.h"
#include "tests/unit/hal/robot/drivers/three_wheels.h"

namespace hal::robot::agent {

/// Remembers what it was told.
class RecordedWheels final : public drivers::WheelDriver {
 public:
  explicit RecordedWheels(drivers::SpeedLimits limits = {})
      : drivers::WheelDriver(node::devices::WheelDrive(drivers::three_wheels()), limits) {}

  Result<void> drive(const Twist2& body, platform::BootTime at) override {
    if (!reachable) return fail(Errc::kNotConnected, "cable");
    const std::lock_guard lock(mutex_);
    twist = body;
    as_of = at;
    ++commands;
    return {};
  }
  void keep(platform::BootTime at) override {
    const std::lock_guard lock(mutex_);
    kept = at;
  }
  void stop() override {
    const std::lock_guard lock(mutex_);
    twist = {};
    ++stops;
  }
  Result<void> stop_and_wait(Duration) override {
    stop();
    return {};
  }
  Result<drivers::WheelState> state() const override {
    if (!odometry) return fail(Errc::kTimeout, "too old");
    return drivers::WheelState{{1, 2, 3}, twist, platform::BootClock::now()};
  }
  bool connected() const override { return reachable; }
  std::string trouble() const override { return reachable ? "" : "cable"; }
  platform::DeviceCounts counts() const override { return {}; }

  Twist2 twist;
  platform::BootTime as_of, kept;  ///< Of the last drive() and keep().
  int commands = 0, stops = 0;
  bool reachable = true, odometry = true;

 private:
  std::mutex mutex_;  ///< Of what is written; tests read when nobody writes.
};

/// One value for all sensors, or silence.
class FixedInfrared final : public drivers::InfraredDriver {
 public:
  Result<drivers::InfraredReadings> latest() const override {
    if (!metres) return fail(Errc::kTimeout, "too old");
    return drivers::InfraredReadings{{*metres}, {0.5}, platform::BootClock::now()};
  }
  bool connected() const override { return metres.has_value(); }
  std::string trouble() const override { return {}; }
  platform::DeviceCounts counts() const override { return {}; }

  std::optional<double> metres = 0.25;
};

using tests::ScriptedPort;

inline node::exchange::Action drive_action(const Twist2& twist) {
  return {.what = node::exchange::DriveBody{twist}};
}

inline node::exchange::Action send_action(AgentId to, MessageId id, Bytes payload = {1, 2, 3}) {
  return {.what = node::exchange::Send{
              .id = id, .destination = to, .topic = "test", .payload = std::move(payload)}};
}

}  // namespace hal::robot::agent
