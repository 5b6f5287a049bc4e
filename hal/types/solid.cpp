#include "hal/types/solid.h"

#include "hal/types/math.h"

namespace hal {

Vec3 centre_in_world(const Solid& solid, const Pose2& frame) {
  const double c = math::cos(frame.theta), s = math::sin(frame.theta);
  return {frame.x + c * solid.centre.x - s * solid.centre.y,
          frame.y + s * solid.centre.x + c * solid.centre.y, solid.centre.z};
}

}  // namespace hal
