#pragma once

#include <optional>

#include "hal/types/geometry.h"

namespace hal::robot::drivers {

/// Converts odometry with an arbitrary origin to odometry that starts at pose 0, without a jump
/// when the device restarts.
class OdometryFrame {
 public:
  /// @param raw       pose in the device's own frame.
  /// @param sequence  increases while the device runs; a decrease indicates a restart.
  /// @return the pose in the frame of the first call.
  Pose2 update(const Pose2& raw, double sequence);

 private:
  /// Transformation from the device's frame to ours: a rotation by theta, then a translation by (x,
  /// y).
  std::optional<Pose2> origin_;
  Pose2 last_;
  double last_sequence_ = 0;
};

}  // namespace hal::robot::drivers
