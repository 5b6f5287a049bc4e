#include "sim/agents/path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hal/types/math.h"

namespace sim::agents {
namespace {

using namespace std::chrono_literals;
using hal::Time;
using hal::Vec2;

constexpr double kExact = 1e-9;  // m
constexpr double kPi = hal::math::kPi;

std::unique_ptr<Path> path(const PathDescription& description, const hal::Pose2& start = {},
                           std::uint64_t seed = 1, const std::string& agent = "a") {
  return make_path(description, start, seed, agent);
}

void expect_at(const Path& path, hal::Duration at, Vec2 expected) {
  const Vec2 found = path.at(Time{at}).position;
  EXPECT_NEAR(found.x, expected.x, kExact) << hal::to_seconds(at);
  EXPECT_NEAR(found.y, expected.y, kExact) << hal::to_seconds(at);
}

TEST(Path, WithoutMotionHoldsForEver) {
  const auto standing = path({}, {3, 4, 1});
  expect_at(*standing, 1000s, {3, 4});
  EXPECT_EQ(standing->at(Time{5s}).valid_until, Time::max());
  EXPECT_EQ(standing->at(Time{5s}).heading, 1);
  EXPECT_EQ(standing->max_speed(), 0);
}

TEST(Path, AlongALineTurnsBackAfterItsLengthAndItsPause) {
  const auto line = path(LinePath{.speed = 2, .length = 10, .pause = 3s}, {1, 0, kPi / 2});
  expect_at(*line, 0s, {1, 0});
  expect_at(*line, 4s, {1, 8});
  expect_at(*line, 5s, {1, 10});
  expect_at(*line, 7s, {1, 10});
  EXPECT_EQ(line->at(Time{6s}).valid_until, Time{8s});
  EXPECT_EQ(line->at(Time{6s}).velocity, Vec2{});
  expect_at(*line, 9s, {1, 8});
  EXPECT_NEAR(line->at(Time{9s}).velocity.y, -2, kExact);
  expect_at(*line, 13s + 3s + 1s, {1, 2});
  EXPECT_EQ(line->max_speed(), 2);
}

TEST(Path, AlongALineWithoutLengthGoesOnForEver) {
  const auto line = path(LinePath{.speed = 1.5}, {0, 0, 0});
  expect_at(*line, 100'000s, {150'000, 0});
}

TEST(Path, OnACircleKeepsRadiusAndSpeedAndComesRound) {
  for (const bool clockwise : {false, true}) {
    const auto circle =
        path(CirclePath{.radius = 20, .speed = 4, .clockwise = clockwise}, {5, 0, 0});
    const Vec2 centre{5, clockwise ? -20.0 : 20.0};
    expect_at(*circle, 0s, {5, 0});
    for (int second = 0; second < 50; ++second) {
      const PathState state = circle->at(Time{std::chrono::seconds{second}});
      const Vec2 out = state.position - centre;
      EXPECT_NEAR(dot(out, out), 400, 1e-6);
      EXPECT_NEAR(dot(out, state.velocity), 0, 1e-6);
      EXPECT_NEAR(dot(state.velocity, state.velocity), 16, 1e-6);
    }
    const Vec2 round = circle->at(Time{hal::from_seconds(2 * kPi * 20 / 4)}).position;
    EXPECT_NEAR(round.x, 5, 1e-7);
    EXPECT_NEAR(round.y, 0, 1e-7);
  }
}

TEST(Path, OfWaypointsStaysAtTheLastOrBeginsAgain) {
  WaypointPath points{.points = {{10, 0}, {10, 10}}, .speed = 1, .pause = 1s, .repeat = false};
  const auto once = path(points);
  expect_at(*once, 10s, {10, 0});
  expect_at(*once, 16s, {10, 5});
  expect_at(*once, 1000s, {10, 10});
  EXPECT_EQ(once->at(Time{1000s}).valid_until, Time::max());
  points.repeat = true;
  const auto again = path(points);
  expect_at(*again, 22s + 4s, {10, 6});
  expect_at(*again, 16s, {10, 5});  // asked for again, later
}

const RandomWaypointPath kRandom{
    .from = {-50, 0}, .to = {50, 80}, .speed_low = 1, .speed_high = 3, .pause = 2s};

TEST(Path, AtRandomStaysInItsRectangleBelowItsSpeedWithoutJumps) {
  const auto random = path(kRandom, {0, 40, 0});
  Vec2 before = random->at(Time{}).position;
  int pauses = 0;
  for (int tenth = 1; tenth < 20'000; ++tenth) {
    const PathState state = random->at(Time{tenth * 100ms});
    EXPECT_GE(state.position.x, -50);
    EXPECT_LE(state.position.x, 50);
    EXPECT_GE(state.position.y, 0);
    EXPECT_LE(state.position.y, 80);
    const Vec2 step = state.position - before;
    EXPECT_LE(std::sqrt(dot(step, step)), 0.3 + kExact);
    pauses += state.velocity == Vec2{} ? 1 : 0;
    before = state.position;
  }
  EXPECT_GT(pauses, 100);
}

TEST(Path, AtRandomDependsOnSeedAndNameAndNotOnWhenItIsAskedFor) {
  const auto first = path(kRandom), same = path(kRandom), other = path(kRandom, {}, 2),
             named = path(kRandom, {}, 1, "b");
  const auto late = same->at(Time{500s}).position;  // before the earlier ones
  for (int second = 0; second <= 500; second += 50) {
    const Time at{std::chrono::seconds{second}};
    EXPECT_EQ(first->at(at).position, same->at(at).position);
  }
  EXPECT_EQ(first->at(Time{500s}).position, late);
  EXPECT_NE(other->at(Time{500s}).position, late);
  EXPECT_NE(named->at(Time{500s}).position, late);
}

}  // namespace
}  // namespace sim::agents
