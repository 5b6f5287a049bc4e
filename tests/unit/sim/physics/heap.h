#pragma once

#include <cmath>

#include "hal/types/math.h"
#include "sim/core/fingerprint.h"
#include "sim/physics/world.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::physics::test {

/// Twenty robots on two circles that all press towards one point, turning as they meet, and later
/// drive apart.
class Heap {
 public:
  static constexpr int kRobots = 20;

  explicit Heap(hal::node::devices::WheelLevel level) : world_(WorldConfig{}) {
    for (int i = 0; i < kRobots; ++i) {
      const double angle = 2 * hal::math::kPi * i / kRobots;
      const double radius = i % 2 == 0 ? 1.3 : 1.8;
      world_.add_robot(robot(i), robertino(level),
                       {radius * hal::math::cos(angle), radius * hal::math::sin(angle), 0.7 * i});
    }
  }

  /// One step. @param sign  +1: towards the middle, -1: away from it.
  void step(double sign) {
    if (world_.steps() % 10 == 0)
      for (int i = 0; i < kRobots; ++i) steer(i, sign);
    world_.step();
    for (int i = 0; i < kRobots; ++i) worst_ = std::max(worst_, world_.pose(robot(i)).tilt);
  }

  const World& world() const { return world_; }
  double worst_tilt() const { return worst_; }  ///< rad, since the start.
  static AgentId robot(int i) { return AgentId{static_cast<std::uint16_t>(i + 1)}; }

  std::uint64_t fingerprint() const {
    Hash hash;
    for (int i = 0; i < kRobots; ++i) {
      const BodyPose pose = world_.pose(robot(i));
      for (const double v : {pose.position.x, pose.position.y, pose.position.z}) hash.add(v);
      for (const double v : pose.quaternion) hash.add(v);
    }
    return hash.value();
  }

 private:
  void steer(int i, double sign) {
    const BodyPose pose = world_.pose(robot(i));
    const double bearing = hal::math::atan2(-pose.position.y, -pose.position.x) - pose.heading;
    const double speed = 0.6 * sign;
    const hal::Twist2 twist{speed * hal::math::cos(bearing), speed * hal::math::sin(bearing),
                            0.3 * (i % 3 - 1)};
    EXPECT_TRUE(world_.set_body_velocity(robot(i), twist));
  }

  World world_;
  double worst_ = 0;
};

}  // namespace sim::physics::test
