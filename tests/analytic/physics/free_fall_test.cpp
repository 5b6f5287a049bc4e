#include <gtest/gtest.h>

#include <algorithm>

#include "sim/physics/world.h"

namespace sim::physics::test {
namespace {

constexpr AgentId kMote{1};
constexpr double kHeight = 6;  // m
constexpr double kGravity = 9.81;

double fallen_after(std::chrono::milliseconds step, int steps) {
  World world(WorldConfig{.step = step});
  world.add_mote(kMote, {}, {}, kHeight);
  for (int i = 0; i < steps; ++i) world.step();
  return kHeight - world.pose(kMote).position.z;
}

TEST(FreeFall, FollowsTheClosedFormOfTheIntegrator) {
  // Semi-implicit Euler from rest: v_n = g n dt, z_n = g dt^2 n (n + 1) / 2.
  World world(WorldConfig{});
  world.add_mote(kMote, {}, {}, kHeight);
  const double dt = 0.01;
  for (int n = 1; n <= 100; ++n) {
    world.step();
    EXPECT_NEAR(kHeight - world.pose(kMote).position.z, kGravity * dt * dt * n * (n + 1) / 2,
                1e-12);  // m: rounding of 100 sums
    EXPECT_NEAR(world.velocity(kMote).linear.z, -kGravity * n * dt, 1e-12);
  }
}

TEST(FreeFall, ErrorOfTheIntegratorIsOfFirstOrder) {
  const double exact = kGravity / 2;  // after 1 s
  const double coarse = fallen_after(std::chrono::milliseconds(20), 50) - exact;
  const double fine = fallen_after(std::chrono::milliseconds(10), 100) - exact;
  EXPECT_NEAR(coarse, kGravity * 0.02 / 2, 1e-11);  // m: g dt t / 2
  EXPECT_NEAR(coarse / fine, 2, 1e-8);
}

TEST(FreeFall, ImpactKeepsNoEnergyOfTheFall) {
  World world(WorldConfig{});
  world.add_mote(kMote, {}, {}, 0.5);  // m: 4.9 J per kg
  double highest = -1;                 // J per kg, after the impact
  bool landed = false;
  for (int i = 0; i < 200; ++i) {
    world.step();
    const double v = world.velocity(kMote).linear.z;
    const double z = world.pose(kMote).position.z;
    landed = landed || z < 0;
    if (landed && v > -1) highest = std::max(highest, v * v / 2 + kGravity * z);
  }
  // Contacts push back out at max_correcting_velocity, 0.1 m/s: 0.005 J per kg, and the surface
  // layer of 1e-4 m is worth 0.001.
  EXPECT_LT(highest, 0.006);
  EXPECT_TRUE(world.asleep(kMote));
  EXPECT_NEAR(world.pose(kMote).position.z, 0, 2e-4);  // m: surface layer
}

}  // namespace
}  // namespace sim::physics::test
