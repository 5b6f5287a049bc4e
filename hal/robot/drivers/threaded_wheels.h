#pragma once

#include <memory>
#include <string>

#include "hal/robot/drivers/velocity_command.h"
#include "hal/robot/drivers/wheels.h"
#include "hal/robot/platform/device_thread.h"

namespace hal::robot::drivers {

/// A device that takes velocities. connect() and send() come from one thread.
class WheelDevice {
 public:
  struct Sent {
    Twist2 body;             ///< What the velocity was when it was written.
    bool confirmed = false;  ///< The device has said already that it took it.
  };

  virtual ~WheelDevice() = default;
  /// Reaches the device and leaves its wheels standing.
  virtual Result<void> connect() = 0;
  /// Writes what the velocity is by then, asking the clock right before.
  virtual Result<Sent> send(const TimedVelocity& velocity) = 0;
  /// Any thread. @param thread  that of connect() and send().
  virtual Result<WheelState> state(const platform::DeviceThread& thread) const = 0;
  /// Answers against the protocol that were passed over without losing the device. Any thread.
  virtual std::uint64_t passed_over() const { return 0; }
};

/// A WheelDriver that sends the last velocity to a device at a period, and a new one at once. One
/// that ran out between the look at the clock and the write is followed by zero without delay.
class ThreadedWheels final : public WheelDriver, private platform::Device {
 public:
  struct Setup {
    node::devices::WheelDrive kinematics;
    SpeedLimits limits;
    Duration command_timeout{};  ///< How long a velocity holds, > 0.
    platform::DeviceThread::Rules rules;
  };

  ThreadedWheels(std::unique_ptr<WheelDevice> device, const Setup& setup);
  ~ThreadedWheels() override;

  Result<void> drive(const Twist2& body, platform::BootTime as_of) override;
  void keep(platform::BootTime as_of) override { command_.keep(as_of); }
  void stop() override;
  Result<void> stop_and_wait(Duration at_most) override;
  Result<WheelState> state() const override { return device_->state(thread_); }
  bool connected() const override { return thread_.connected(); }
  std::string trouble() const override { return thread_.trouble(); }
  platform::DeviceCounts counts() const override;

 private:
  Result<void> connect() override;
  Result<void> work() override;
  void on_lost() override { command_.stop(); }
  void leave() override;

  std::unique_ptr<WheelDevice> device_;
  VelocityCommand command_;
  platform::DeviceThread thread_;  ///< Last: it uses the others.
};

}  // namespace hal::robot::drivers
