#pragma once

#include <string>
#include <utility>

#include "hal/node/devices/wheel_drive.h"
#include "hal/node/exchange/session.h"
#include "hal/robot/drivers/speed_limits.h"
#include "hal/robot/platform/boot_time.h"
#include "hal/robot/platform/device_counts.h"
#include "hal/types/geometry.h"
#include "hal/types/result.h"
#include "hal/types/time.h"

namespace hal::robot::drivers {

/// What the device says of its own motion.
struct WheelState {
  Pose2 pose;    ///< Dead reckoning, in the frame the robot had when the driver first reached it.
  Twist2 twist;  ///< Measured, body frame.
  platform::BootTime stamp;
};

/// The wheels of a real robot. Every call returns at once; the driver's own threads talk to the
/// device, repeat the last velocity as often as the device's rule wants it, and reconnect, waiting
/// 100 ms, 200 ms, … 2 s between attempts. A velocity does not survive a lost connection: after a
/// reconnection the wheels stand until the next drive().
///
/// Nor does it outlive the file's `command_timeout`, by the BootClock as the driver's thread reads
/// it right before each write: a thread that was halted in between, or a computer that slept, does
/// not repeat what was true before. Any thread.
class WheelDriver {
 public:
  /// Stops the wheels, waiting for the device's answer no longer than its time-out.
  virtual ~WheelDriver() = default;
  WheelDriver(const WheelDriver&) = delete;
  WheelDriver& operator=(const WheelDriver&) = delete;

  /// The velocity from now on, body frame. @pre it is within limits() and speed_limits():
  /// DriveGuard sees to it.
  /// @param as_of  when this was known to be right: the command timeout is counted from then.
  /// Errors: kInvalidArgument (not finite; the old velocity holds), kNotConnected (the wheels
  /// stop once the device is heard again).
  virtual Result<void> drive(const Twist2& body, platform::BootTime as_of) = 0;

  /// The last velocity is still right: the command timeout is counted anew from `as_of`. One that
  /// had timed out before stays so.
  virtual void keep(platform::BootTime as_of) = 0;

  /// Velocity zero, sent at once, ahead of everything else the driver has to do.
  virtual void stop() = 0;

  /// Stops, and waits until the device has taken it. Errors: kTimeout, kNotConnected (the device's
  /// own rule stops it).
  virtual Result<void> stop_and_wait(Duration at_most) = 0;

  /// The last odometry. Errors: kNotConnected, kNotAvailable (none yet), kTimeout (the last one is
  /// too old to be used; which age that is, the file says).
  virtual Result<WheelState> state() const = 0;

  virtual bool connected() const = 0;
  /// Why the device is not connected, for people; empty while it is.
  virtual std::string trouble() const = 0;
  virtual platform::DeviceCounts counts() const = 0;

  const node::devices::WheelDrive& kinematics() const { return kinematics_; }
  const SpeedLimits& speed_limits() const { return speed_limits_; }
  /// As a session states them.
  node::exchange::DriveLimits limits() const {
    return {.body_to_wheel = kinematics_.body_to_wheel(),
            .wheel_to_body = kinematics_.restrictions(),
            .wheel_speed = kinematics_.max_wheel_speed()};
  }

 protected:
  WheelDriver(node::devices::WheelDrive kinematics, SpeedLimits limits)
      : kinematics_(std::move(kinematics)), speed_limits_(limits) {}

 private:
  node::devices::WheelDrive kinematics_;
  SpeedLimits speed_limits_;
};

}  // namespace hal::robot::drivers
