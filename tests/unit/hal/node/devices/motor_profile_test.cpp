#include "hal/node/devices/motor_profile.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

namespace hal::node::devices {
namespace {

using namespace std::chrono_literals;

constexpr double kRounding = 1e-12;  // sums of at most 200 steps of size 1

Twist2 after(MotorProfile& profile, const Twist2& target, Duration time, Duration step = 10ms) {
  for (Duration t{}; t < time; t += step) profile.advance(target, step);
  return profile.velocity();
}

TEST(MotorProfile, SpeedsUpAndBrakesAtDifferentRates) {
  MotorProfile profile({0.8, 1.5, 1.6, 3.14});
  EXPECT_NEAR(after(profile, {1, 0, 0}, 500ms).vx, 0.4, kRounding);
  EXPECT_NEAR(after(profile, {0, 0, 0}, 100ms).vx, 0.4 - 0.15, kRounding);
  EXPECT_NEAR(after(profile, {0, 0, 2}, 500ms).omega, 0.8, kRounding);
  EXPECT_NEAR(after(profile, {0, 0, 0}, 100ms).omega, 0.8 - 0.314, kRounding);
}

TEST(MotorProfile, ReversalBrakesToRestAndThenSpeedsUp) {
  MotorProfile profile({0.8, 1.5, 1.6, 3.14});
  profile.reset({0.3, 0, 0});
  EXPECT_NEAR(after(profile, {-0.4, 0, 0}, 200ms).vx, 0, kRounding);  // 0.3 / 1.5 = 0.2 s
  EXPECT_NEAR(after(profile, {-0.4, 0, 0}, 250ms).vx, -0.2, kRounding);
  EXPECT_EQ(after(profile, {-0.4, 0, 0}, 260ms).vx, -0.4);
}

TEST(MotorProfile, StepAcrossRestSplitsItsTime) {
  MotorProfile profile({0.8, 1.5, 1.6, 3.14});
  profile.reset({0, 0.006, 0});
  // 4 ms of braking, 6 ms of speeding up the other way.
  EXPECT_NEAR(profile.advance({0, -1, 0}, 10ms).vy, -0.8 * 0.006, kRounding);
}

TEST(MotorProfile, LinearVelocityMovesOnAStraightLineToTheCommand) {
  MotorProfile profile({0.8, 1.5, 1.6, 3.14});
  profile.reset({0.6, 0, 0});
  for (int i = 0; i < 60; ++i) {
    const Twist2 v = profile.advance({0, 0.6, 0}, 10ms);
    EXPECT_NEAR(v.vx + v.vy, 0.6, kRounding);
  }
  // Shrinks over 0.6/sqrt2 at 1.5, grows over 0.6/sqrt2 at 0.8: 0.283 + 0.530 s.
  EXPECT_NE(profile.velocity(), (Twist2{0, 0.6, 0}));
  EXPECT_EQ(after(profile, {0, 0.6, 0}, 220ms), (Twist2{0, 0.6, 0}));
}

TEST(MotorProfile, ResultDoesNotDependOnTheStep) {
  MotorProfile fine({0.8, 1.5, 1.6, 3.14});
  MotorProfile coarse({0.8, 1.5, 1.6, 3.14});
  fine.reset({0.3, 0.1, -1});
  coarse.reset({0.3, 0.1, -1});
  const Twist2 a = after(fine, {-0.5, 0.2, 1}, 600ms, 1ms);
  const Twist2 b = after(coarse, {-0.5, 0.2, 1}, 600ms, 20ms);
  EXPECT_NEAR(a.vx, b.vx, kRounding);
  EXPECT_NEAR(a.vy, b.vy, kRounding);
  EXPECT_NEAR(a.omega, b.omega, kRounding);
}

}  // namespace
}  // namespace hal::node::devices
