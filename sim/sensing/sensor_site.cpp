#include "sim/sensing/sensor_site.h"

namespace sim::sensing {

hal::Pose2 pose_before(const SensorSite& site, hal::Duration age) {
  const physics::BodyPose pose = site.world.pose(site.agent);
  const physics::BodyVelocity velocity = site.world.velocity(site.agent);
  const double seconds = hal::to_seconds(age);
  return {pose.position.x - seconds * velocity.linear.x,
          pose.position.y - seconds * velocity.linear.y,
          pose.heading - seconds * velocity.angular.z};
}

}  // namespace sim::sensing
