#include "controllers/help/way_past.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using controllers::kLookAhead;
using controllers::way_past;
using hal::Vec2;

constexpr double kClearance = 0.35;  // m
const Vec2 kAhead{1, 0};

/// Distance of a point from the ray along `way`, m.
double distance(Vec2 way, Vec2 point) { return std::abs(way.x * point.y - way.y * point.x); }

TEST(WayPast, IsTheWayItselfIfNobodyStandsInIt) {
  const std::vector<double> clear{3,  1.0, 0.36, 4, -0.5, 0.0, 5, controllers::kLookAhead + 0.01,
                                  0.0};
  EXPECT_EQ(way_past(kAhead, clear, kClearance), kAhead);
  EXPECT_EQ(way_past(kAhead, {}, kClearance), kAhead);
}

TEST(WayPast, PassesOnTheSideWithLessToGoRound) {
  const std::vector<double> to_the_left{3, 1.0, 0.1}, to_the_right{3, 1.0, -0.1};
  EXPECT_LT(way_past(kAhead, to_the_left, kClearance).y, 0);
  EXPECT_GT(way_past(kAhead, to_the_right, kClearance).y, 0);
}

TEST(WayPast, GoesRoundTheNearestFirst) {
  const std::vector<double> two{3, 1.2, 0.1, 4, 0.6, -0.1};
  EXPECT_GT(way_past(kAhead, two, kClearance).y, 0);
}

// Driven in small steps from any direction, the robot's centre keeps the clearance to within a
// step: 9.4 cm at 0.94 m/s and 10 Hz, at most 2 cm of it sideways this close to the tangent.
TEST(WayPast, KeepsItsDistanceFromAMoteOnTheWayToAGoalBehindIt) {
  for (double offset = -0.3; offset <= 0.3; offset += 0.05) {
    Vec2 robot{0, 0};
    const Vec2 goal{10, 0}, mote{5, offset};
    double nearest = 10;
    for (int step = 0; step < 120 && distance({0, 1}, goal - robot) > 0.1; ++step) {
      const Vec2 to = goal - robot, seen = mote - robot;
      const Vec2 way = 1 / std::sqrt(hal::dot(to, to)) * to;
      const std::vector<double> localised{3, seen.x, seen.y};
      robot = robot + 0.094 * controllers::way_past(way, localised, kClearance);
      nearest = std::min(nearest, std::sqrt(hal::dot(mote - robot, mote - robot)));
    }
    EXPECT_GT(nearest, kClearance - 0.02) << "offset " << offset;
    EXPECT_NEAR(robot.x, goal.x, 0.2);
  }
}

}  // namespace
