#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal/hardware/hardware_agent.h"
#include "tests/support/scripted_port.h"
#include "tests/unit/hal/hardware/drivers/three_wheels.h"

namespace hal::hardware {

/// Remembers what it was told.
class RecordedWheels final : public WheelDriver {
 public:
  explicit RecordedWheels(SpeedLimits limits = {})
      : WheelDriver(devices::WheelDrive(three_wheels()), limits) {}

  Result<void> drive(const Twist2& body, BootTime at) override {
    if (!reachable) return fail(Errc::kNotConnected, "cable");
    const std::lock_guard lock(mutex_);
    twist = body;
    as_of = at;
    ++commands;
    return {};
  }
  void keep(BootTime at) override {
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
  Result<WheelState> state() const override {
    if (!odometry) return fail(Errc::kTimeout, "too old");
    return WheelState{{1, 2, 3}, twist, BootClock::now()};
  }
  bool connected() const override { return reachable; }
  std::string trouble() const override { return reachable ? "" : "cable"; }
  DeviceCounts counts() const override { return {}; }

  Twist2 twist;
  BootTime as_of, kept;  ///< Of the last drive() and keep().
  int commands = 0, stops = 0;
  bool reachable = true, odometry = true;

 private:
  std::mutex mutex_;  ///< Of what is written; tests read when nobody writes.
};

/// One value for all sensors, or silence.
class FixedInfrared final : public InfraredDriver {
 public:
  Result<InfraredReadings> latest() const override {
    if (!metres) return fail(Errc::kTimeout, "too old");
    return InfraredReadings{{*metres}, {0.5}, BootClock::now()};
  }
  bool connected() const override { return metres.has_value(); }
  std::string trouble() const override { return {}; }
  DeviceCounts counts() const override { return {}; }

  std::optional<double> metres = 0.25;
};

using tests::ScriptedPort;

inline exchange::Action drive_action(const Twist2& twist) {
  exchange::Action action;
  action.kind = exchange::ActionKind::kDriveBody;
  action.twist = twist;
  return action;
}

inline exchange::Action send_action(AgentId to, MessageId id, Bytes payload = {1, 2, 3}) {
  exchange::Action action;
  action.kind = exchange::ActionKind::kSend;
  action.message_id = id;
  action.destination = to;
  action.topic = "test";
  action.payload = std::move(payload);
  return action;
}

}  // namespace hal::hardware
