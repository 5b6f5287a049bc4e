#pragma once

#include <memory>
#include <string>

#include "hal/hardware/device_thread.h"
#include "hal/hardware/velocity_command.h"
#include "hal/hardware/wheels.h"

namespace hal::hardware {

/// A device that takes velocities. connect() and send() come from one thread.
class WheelDevice {
 public:
  virtual ~WheelDevice() = default;
  /// Reaches the device and leaves its wheels standing.
  virtual Result<void> connect() = 0;
  /// @return whether the device has confirmed this velocity already.
  virtual Result<bool> send(const Twist2& body) = 0;
  /// Any thread. @param thread  that of connect() and send().
  virtual Result<WheelState> state(const DeviceThread& thread) const = 0;
  /// Answers against the protocol that were passed over without losing the device. Any thread.
  virtual std::uint64_t passed_over() const { return 0; }
};

/// A WheelDriver that sends the last velocity to a device at a period, and a new one at once.
class ThreadedWheels final : public WheelDriver, private Device {
 public:
  struct Setup {
    devices::WheelDrive kinematics;
    SpeedLimits limits;
    DeviceThread::Rules rules;
  };

  ThreadedWheels(std::unique_ptr<WheelDevice> device, const Setup& setup);
  ~ThreadedWheels() override;

  Result<void> drive(const Twist2& body) override;
  void stop() override;
  Result<void> stop_and_wait(Duration at_most) override;
  Result<WheelState> state() const override { return device_->state(thread_); }
  bool connected() const override { return thread_.connected(); }
  std::string trouble() const override { return thread_.trouble(); }
  DeviceCounts counts() const override;

 private:
  Result<void> connect() override;
  Result<void> work() override;
  void on_lost() override { command_.set({}); }
  void leave() override;

  std::unique_ptr<WheelDevice> device_;
  VelocityCommand command_;
  DeviceThread thread_;  ///< Last: it uses the others.
};

}  // namespace hal::hardware
