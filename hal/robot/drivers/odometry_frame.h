#pragma once

#include <optional>

#include "hal/types/geometry.h"

namespace hal::robot::drivers {

/// Turns odometry that a device counts from somewhere into odometry from pose 0, without a jump
/// when the device begins anew.
class OdometryFrame {
 public:
  /// @param raw       pose in the device's own frame.
  /// @param sequence  grows while the device counts on; a smaller one says that it began anew.
  /// @return the pose in the frame of the first call.
  Pose2 update(const Pose2& raw, double sequence);

 private:
  /// Device frame to ours: turned by theta, then moved by (x, y).
  std::optional<Pose2> origin_;
  Pose2 last_;
  double last_sequence_ = 0;
};

}  // namespace hal::robot::drivers
