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

/// The motion that the device reports.
struct WheelState {
  Pose2 pose;    ///< Dead reckoning, in the frame of the robot when the driver first reached it.
  Twist2 twist;  ///< Measured, body frame.
  platform::BootTime stamp;
};

/// The wheels of a real robot. No call blocks, except where stated; the driver's own threads
/// communicate with the device, repeat the last velocity as often as the device requires, and
/// reconnect, waiting 100 ms, 200 ms, … 2 s between attempts. A velocity does not survive a lost
/// connection: after a reconnection the wheels stand still until the next drive().
///
/// A velocity expires after the file's `command_timeout`, by the BootClock that the driver's thread
/// reads right before each write: a thread that was halted in between, or a suspended computer,
/// does not repeat an outdated velocity. Any thread.
class WheelDriver {
 public:
  /// Stops the wheels, waiting for the device's answer at most its time-out.
  virtual ~WheelDriver() = default;
  WheelDriver(const WheelDriver&) = delete;
  WheelDriver& operator=(const WheelDriver&) = delete;

  /// Sets the velocity, body frame. @pre it is within limits() and speed_limits(), which DriveGuard
  /// ensures.
  /// @param as_of  when the command arrived: the command timeout counts from then.
  /// Errors: kInvalidArgument (not finite; the old velocity holds), kNotConnected (the wheels stop
  /// once the device is reached again).
  virtual Result<void> drive(const Twist2& body, platform::BootTime as_of) = 0;

  /// The last velocity is still valid: the command timeout counts again from `as_of`. A velocity
  /// that had expired before remains expired.
  virtual void keep(platform::BootTime as_of) = 0;

  /// Sets the velocity to zero and sends it at once, before anything else.
  virtual void stop() = 0;

  /// Stops and waits until the device has accepted it. Errors: kTimeout, kNotConnected (the device
  /// stops by its own time-out).
  virtual Result<void> stop_and_wait(Duration at_most) = 0;

  /// The last odometry. Errors: kNotConnected, kNotAvailable (none yet), kTimeout (it is older than
  /// `stale_after` of the file).
  virtual Result<WheelState> state() const = 0;

  virtual bool connected() const = 0;
  /// Why the device is not connected, for messages; empty while it is.
  virtual std::string trouble() const = 0;
  virtual platform::DeviceCounts counts() const = 0;

  const node::devices::WheelDrive& kinematics() const { return kinematics_; }
  const SpeedLimits& speed_limits() const { return speed_limits_; }
  /// The limits as a session states them.
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
