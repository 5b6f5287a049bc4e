#include "sim/sensing/sonar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

#include "hal/types/math.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::sensing::test {
namespace {

using hal::AgentId;
using hal::math::kPi;
using hal::node::devices::Sonar;
using namespace std::chrono_literals;

constexpr AgentId kDriver{1}, kOther{2};
constexpr double kTooNear = -std::numeric_limits<double>::infinity();

Sonar ranger() {
  Sonar sonar;
  sonar.mount.position = {0, 0, 0.15};
  sonar.half_angle = hal::math::kPi / 12;
  sonar.min_range = 0.3;
  sonar.max_range = 3;
  return sonar;
}

/// A robot with a sonar in its middle; walls 0.5 m ahead, 2 m to the left, 5 m behind and 0.2 m to
/// the right of that, another robot ahead and to the left, at 45 degrees and 1 m.
struct Yard {
  explicit Yard(const Sonar& sonar) : world(physics::WorldConfig{}) {
    world.add_wall({"ahead", {1.5, 0, 0.5}, {2, 0.1, 1}, 0});
    world.add_wall({"left", {0, 3, 0.5}, {0.1, 2, 1}, 0});
    world.add_wall({"behind", {-6, 0, 0.5}, {2, 0.1, 1}, 0});
    world.add_wall({"right", {0, -0.71, 0.5}, {0.02, 1.02, 1}, 0});
    world.add_robot(kDriver, physics::test::robertino(), {});
    world.add_robot(kOther, physics::test::robertino(), {std::sqrt(0.5), std::sqrt(0.5), 0});
    proximity.emplace(world);
    sensor = simulated(
        sonar, {kDriver, "r0", 1, world, [this]() -> const Proximity& { return *proximity; }});
  }
  double range(hal::Time at = {}) const { return sensor->sample(at).value().at(0); }

  physics::World world;
  std::optional<Proximity> proximity;
  std::unique_ptr<hal::node::devices::Sensor> sensor;
};

double range_at(double heading) {
  Sonar sonar = ranger();
  sonar.mount.heading = heading;
  return Yard(sonar).range();
}

TEST(Sonar, TellsWallsRobotsNothingAndTooNearButNotItsOwnRobot) {
  EXPECT_NEAR(range_at(0), 0.5, 1e-9);
  EXPECT_NEAR(range_at(kPi / 2), 2, 1e-9);
  EXPECT_TRUE(std::isnan(range_at(kPi)));
  EXPECT_EQ(range_at(-kPi / 2), kTooNear);
  // The robot is a cylinder there, and its radius is less than 1 m / sin 15 deg.
  EXPECT_NEAR(range_at(kPi / 4), 1 - 0.185, 1e-6);
}

TEST(Sonar, SeesBesideItsAxisAsFarAsTheHalfAngle) {
  // The nearest corner of the wall ahead is at (0.5, 0.05) m.
  const double edge = std::atan2(0.05, 0.5);
  Sonar sonar = ranger();
  sonar.mount.heading = edge + sonar.half_angle - 1e-6;
  EXPECT_NEAR(Yard(sonar).range(), std::hypot(0.5, 0.05), 1e-4);
  sonar.mount.heading = edge + sonar.half_angle + 1e-6;
  EXPECT_GT(Yard(sonar).range(), 0.8) << "the other robot";
}

TEST(Sonar, LooksFromWhereItsMountSays) {
  Sonar sonar = ranger();
  sonar.mount.position = {0.1, 0, 0.15};
  EXPECT_NEAR(Yard(sonar).range(), 0.4, 1e-9);
}

TEST(Sonar, HoldsBetweenTwoMeasurements) {
  Sonar sonar = ranger();
  sonar.period = 200ms;
  const Yard yard(sonar);
  int measured = 0;
  for (int k = 0; k < 100; ++k)
    measured += yard.sensor->sample(hal::Time{} + k * 50ms).has_value() ? 1 : 0;
  EXPECT_NEAR(measured, 25, 1) << "5 s at 5 Hz";
}

TEST(Sonar, NoiseHasTheSigmaOfTheFile) {
  Sonar sonar = ranger();
  sonar.noise_sigma = 0.02;
  const Yard yard(sonar);
  constexpr int kSamples = 4000;
  double sum = 0, squares = 0;
  for (int k = 0; k < kSamples; ++k) {
    const double error = yard.range(hal::Time{} + k * 1ms) - 0.5;
    sum += error;
    squares += error * error;
  }
  EXPECT_NEAR(sum / kSamples, 0, 4 * 0.02 / std::sqrt(kSamples));
  EXPECT_NEAR(std::sqrt(squares / kSamples), 0.02, 4 * 0.02 / std::sqrt(2.0 * kSamples));
}

TEST(SonarDescription, RoundsToItsResolutionWithinItsLimits) {
  Sonar sonar = ranger();
  sonar.resolution = 0.004;
  EXPECT_NEAR(sonar.reading(0.5012, 0), 0.5, 1e-12);
  EXPECT_NEAR(sonar.reading(0.5012, 0.002), 0.504, 1e-12) << "the noise comes first";
  EXPECT_EQ(sonar.reading(2.9999, 1), 3);
  EXPECT_EQ(sonar.reading(0.3, -1), 0.3);
}

TEST(SonarDescription, TellsTheEdgesOfItsCone) {
  const hal::Channel channel = ranger().describe();
  EXPECT_EQ(channel.kind, "sonar");
  EXPECT_EQ(channel.length, 1U);
  EXPECT_EQ(channel.headings, (std::vector{-kPi / 12, kPi / 12}));
}

}  // namespace
}  // namespace sim::sensing::test
