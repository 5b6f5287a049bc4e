#pragma once

#include <span>
#include <vector>

#include "hal/node/devices/wheel_drive.h"
#include "hal/types/geometry.h"
#include "hal/types/time.h"

namespace hal::node::devices {

/// Dead reckoning: integrates wheel angles to a pose in the frame of the body at the start. The
/// motion between two updates is assumed to be an arc, which is exact for constant wheel speeds.
class WheelOdometry {
 public:
  /// @param encoder_steps  per turn of a wheel; 0: continuous angles.
  /// Wheel angles start at 0; for a real encoder that starts elsewhere call restart() first.
  explicit WheelOdometry(const WheelDrive& drive, int encoder_steps = 0);

  /// Takes the present wheel angles [rad] as the start: zero pose and twist. @pre one angle per
  /// driven wheel.
  void restart(std::span<const double> wheel_angles);

  /// @param wheel_angles  rad since power-up, not wrapped, one per driven wheel.
  /// @param elapsed  since the previous update, > 0.
  void update(std::span<const double> wheel_angles, Duration elapsed);

  const Pose2& pose() const { return pose_; }     ///< In the frame at the start.
  const Twist2& twist() const { return twist_; }  ///< Mean since the previous update, body frame.

 private:
  double encoded(double angle) const;

  WheelDrive drive_;
  double angle_per_step_;  ///< rad; 0: continuous.
  std::vector<double> previous_;
  Pose2 pose_;
  Twist2 twist_;
};

}  // namespace hal::node::devices
