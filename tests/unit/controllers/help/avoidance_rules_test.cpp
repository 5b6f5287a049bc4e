#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "controllers/help/avoidance.h"

namespace {

using namespace std::chrono_literals;
using controllers::Avoidance;
using hal::Vec2;

constexpr double kPi = 3.14159265358979323846;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Vec2 kAhead{1, 0};

/// What six sensors at multiples of 60 degrees see: (number of the sensor, m).
std::vector<hal::InfraredReading> seeing(const std::vector<std::pair<int, double>>& ranges) {
  std::vector<hal::InfraredReading> infrared;
  for (int i = 0; i < 6; ++i) infrared.push_back({.heading = i * kPi / 3, .range = kNan});
  for (const auto& [sensor, range] : ranges)
    infrared[static_cast<std::size_t>(sensor)].range = range;
  return infrared;
}

/// Six sensors before an endless wall.
/// @param distance  from the robot's middle. @param bearing  of the wall's nearest point, rad.
std::vector<hal::InfraredReading> before_wall(double distance, double bearing) {
  std::vector<std::pair<int, double>> ranges;
  for (int i = 0; i < 6; ++i) {
    const double range = distance / std::cos(i * kPi / 3 - bearing) - 0.185;
    if (range > 0 && range < 0.8) ranges.emplace_back(i, range);
  }
  return seeing(ranges);
}

class AvoidanceRules : public testing::Test {
 protected:
  /// A control cycle of 100 ms later.
  hal::Twist2 steer(const std::vector<hal::InfraredReading>& infrared) {
    now_ += 100ms;
    return avoidance_.steer(kAhead, infrared, now_);
  }

  hal::Twist2 steer_for(hal::Duration duration, const std::vector<hal::InfraredReading>& infrared) {
    hal::Twist2 twist;
    for (const hal::Time end = now_ + duration; now_ < end;) twist = steer(infrared);
    return twist;
  }

  Avoidance avoidance_{{.speed = 0.9, .body_radius = 0.185, .gap = 0.265, .clear_for = 1s}};
  hal::Time now_{};
};

TEST_F(AvoidanceRules, GoesStraightAndAtFullSpeedWhenNothingIsSeen) {
  EXPECT_EQ(steer(seeing({})), (hal::Twist2{.vx = 0.9}));
}

// v = sqrt(2 a (gap - rest)) with a = 0.5 m/s^2 and rest = 0.35 m: 0.5 m/s at a gap of 0.6 m.
TEST_F(AvoidanceRules, BrakesBeforeWhatIsAhead) {
  const hal::Twist2 twist = steer(seeing({{0, 0.6}}));
  EXPECT_NEAR(twist.vx, 0.5, 1e-12);
  EXPECT_NEAR(twist.vy, 0, 1e-12);
  EXPECT_FALSE(avoidance_.follows_wall());
}

TEST_F(AvoidanceRules, PassesByWhatIsBesideTheWay) {
  // At 60 degrees and 0.785 m from the middle: 0.68 m beside the way.
  EXPECT_NEAR(steer(seeing({{1, 0.6}})).vx, 0.9, 1e-12);
}

// The wall's nearest point lies 20 degrees to the left, so to the right it leads on: that is at
// -70 degrees. At a distance of 0.45 m, which is to be kept, there is nothing to correct.
TEST_F(AvoidanceRules, FollowsTheWallToTheSideThatLeadsOnAfterASoftStart) {
  const auto wall = before_wall(0.45, 20 * kPi / 180);
  const hal::Twist2 first = steer(wall);
  EXPECT_TRUE(avoidance_.follows_wall());
  EXPECT_LT(std::hypot(first.vx, first.vy), 0.2) << "from rest";
  const hal::Twist2 later = steer_for(1s, wall);
  EXPECT_NEAR(later.vx, 0.9 * std::cos(70 * kPi / 180), 1e-9);
  EXPECT_NEAR(later.vy, -0.9 * std::sin(70 * kPi / 180), 1e-9);
}

TEST_F(AvoidanceRules, KeepsTheDistanceToTheWallItFollows) {
  steer_for(2s, before_wall(0.45, 0));
  EXPECT_LT(steer(before_wall(0.40, 0)).vx, -0.03) << "too near";
  EXPECT_GT(steer(before_wall(0.50, 0)).vx, 0.03) << "too far";
}

TEST_F(AvoidanceRules, GoesStraightOnAtTheEndOfTheWallUntilTheWayHasBeenClearForAWhile) {
  const hal::Twist2 along = steer_for(2s, before_wall(0.45, 20 * kPi / 180));
  // The last that is seen: the wall at 60 degrees, to the side and behind.
  const hal::Twist2 at_end = steer(seeing({{1, 0.45 / std::cos(40 * kPi / 180) - 0.185}}));
  EXPECT_NEAR(at_end.vx, along.vx, 1e-9);
  EXPECT_NEAR(at_end.vy, along.vy, 1e-9);
  const hal::Twist2 beyond = steer_for(800ms, seeing({}));
  EXPECT_NEAR(beyond.vy, along.vy, 1e-9);
  EXPECT_NEAR(steer_for(200ms, seeing({})).vx, 0.9, 1e-9) << "the way again";
}

/// Follows a wall to the right, loses it, and comes to one that leads on to the left.
TEST_F(AvoidanceRules, KeepsItsSideWhenItMeetsTheWallAgainSoon) {
  steer_for(1s, before_wall(0.45, 20 * kPi / 180));
  steer_for(4s, seeing({}));
  EXPECT_FALSE(avoidance_.follows_wall());
  EXPECT_LT(steer_for(1s, before_wall(0.45, -20 * kPi / 180)).vy, -0.5);
}

TEST_F(AvoidanceRules, PicksItsSideAnewLaterOrForAnotherPoint) {
  steer_for(1s, before_wall(0.45, 20 * kPi / 180));
  steer_for(7s, seeing({}));
  EXPECT_GT(steer_for(1s, before_wall(0.45, -20 * kPi / 180)).vy, 0.5);
  steer_for(1500ms, seeing({}));
  avoidance_.aim_anew();
  EXPECT_LT(steer_for(1s, before_wall(0.45, 20 * kPi / 180)).vy, -0.5);
}

// The wall is 80 degrees to the left, so the drive goes 10 degrees to the right. What the front
// sensor sees is farther than both points of the wall, and leaves room for (gap - 0.1) / 0.4 of the
// speed.
TEST_F(AvoidanceRules, SlowsDownBeforeWhatStandsInTheWayAlongTheWall) {
  const auto wall = before_wall(0.45, 80 * kPi / 180);
  const hal::Twist2 along = steer_for(2s, wall);
  EXPECT_NEAR(along.vx, 0.9 * std::sin(80 * kPi / 180), 1e-9);
  auto corner = wall;
  corner[0].range = 0.42;
  const hal::Twist2 slow = steer(corner);
  const double gap = (0.185 + 0.42) * std::cos(10 * kPi / 180) - 0.185;
  EXPECT_NEAR(std::hypot(slow.vx, slow.vy), 0.9 * (gap - 0.1) / 0.4, 1e-9);
}

// 0.1 m from the body, at 120 degrees: pushed away from there with 0.5 * (0.2 - 0.1) / 0.2 m/s.
TEST_F(AvoidanceRules, IsPushedAwayFromWhatIsVeryNear) {
  const hal::Twist2 twist = steer(seeing({{2, 0.1}}));
  EXPECT_NEAR(std::atan2(twist.vy, twist.vx),
              std::atan2(-0.25 * std::sin(2 * kPi / 3), 0.9 + 0.25 * 0.5), 1e-9);
}

TEST_F(AvoidanceRules, TurnsTheNearestSensorTowardsTheDrive) {
  const double off = 20 * kPi / 180;
  const auto left = avoidance_.steer({std::cos(off), std::sin(off)}, seeing({}), now_);
  EXPECT_NEAR(left.omega, off, 1e-9) << "1/s times the angle, counter-clockwise";
  const auto to_next = avoidance_.steer({std::cos(2 * off), std::sin(2 * off)}, seeing({}), now_);
  EXPECT_NEAR(to_next.omega, -off, 1e-9) << "the sensor at 60 degrees is nearer";
}

}  // namespace
