#pragma once

#include <memory>
#include <string>

#include "hal/robot/drivers/velocity_command.h"
#include "hal/robot/drivers/wheels.h"
#include "hal/robot/platform/device_thread.h"

namespace hal::robot::drivers {

/// A device that accepts velocities. connect() and send() are called from one thread.
class WheelDevice {
 public:
  struct Sent {
    Twist2 body;             ///< The velocity at the time of writing.
    bool confirmed = false;  ///< The device has already acknowledged it.
  };

  virtual ~WheelDevice() = default;
  /// Connects to the device and stops its wheels.
  virtual Result<void> connect() = 0;
  /// Writes the velocity that is in force at that time; reads the clock right before writing.
  virtual Result<Sent> send(const TimedVelocity& velocity) = 0;
  /// Any thread. @param thread  the thread that calls connect() and send().
  virtual Result<WheelState> state(const platform::DeviceThread& thread) const = 0;
  /// Number of invalid answers that were ignored without reconnecting. Any thread.
  virtual std::uint64_t passed_over() const { return 0; }
};

/// A WheelDriver that sends the last velocity to a device periodically, and a new one at once. If a
/// velocity expires between the check of the clock and the write, zero is sent right after it.
class ThreadedWheels final : public WheelDriver, private platform::Device {
 public:
  struct Setup {
    node::devices::WheelDrive kinematics;
    SpeedLimits limits;
    Duration command_timeout{};  ///< How long a velocity is valid, > 0.
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
  platform::DeviceThread thread_;  ///< Last, because it uses the others.
};

}  // namespace hal::robot::drivers
