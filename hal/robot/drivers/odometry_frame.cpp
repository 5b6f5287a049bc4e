#include "hal/robot/drivers/odometry_frame.h"

#include "hal/types/math.h"

namespace hal::robot::drivers {
namespace {

/// `inner`, given in the frame `outer`, transformed to the frame in which `outer` is given.
Pose2 composed(const Pose2& outer, const Pose2& inner) {
  const double c = math::cos(outer.theta);
  const double s = math::sin(outer.theta);
  return {outer.x + c * inner.x - s * inner.y, outer.y + s * inner.x + c * inner.y,
          math::wrap_angle(outer.theta + inner.theta)};
}

/// The frame in which the pose `seen` has the coordinates `raw`.
Pose2 frame_of(const Pose2& seen, const Pose2& raw) {
  const double theta = math::wrap_angle(seen.theta - raw.theta);
  const Pose2 turned = composed({0, 0, theta}, raw);
  return {seen.x - turned.x, seen.y - turned.y, theta};
}

}  // namespace

Pose2 OdometryFrame::update(const Pose2& raw, double sequence) {
  if (!origin_ || sequence < last_sequence_) origin_ = frame_of(last_, raw);
  last_sequence_ = sequence;
  last_ = composed(*origin_, raw);
  return last_;
}

}  // namespace hal::robot::drivers
