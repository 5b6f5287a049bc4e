#include "sim/sensing/infrared.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "hal/types/math.h"
#include "sim/sensing/relative_localisation.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::sensing::test {
namespace {

using hal::AgentId;
using hal::math::kPi;
using physics::World;
using physics::test::robertino;
using namespace std::chrono_literals;

constexpr AgentId kRobot{1};
constexpr double kCount = 5.0 / 1023;  // V per count of the converter

std::vector<hal::node::devices::InfraredSensor> quiet_sensors() {
  auto sensors = physics::test::robertino().infrared;
  for (auto& sensor : sensors) sensor.noise_sigma = 0;
  return sensors;
}

/// A robot whose front sensor is `gap` metres from a wall.
void face_wall(World& world, double gap) {
  world.add_wall({"wall", {0.185 + gap + 0.1, 0, 0.5}, {0.2, 10, 1}, 0});
  world.add_robot(kRobot, physics::test::robertino(), {});
}

TEST(Infrared, FrontSensorReadsTheWallAndTheRearOneNothing) {
  World world(physics::WorldConfig{});
  face_wall(world, 0.4);
  const Proximity proximity(world);
  InfraredArray array(kRobot, quiet_sensors(), 1, "r0");
  EXPECT_TRUE(array.readings().empty());
  array.sample(hal::Time{}, world, proximity);
  ASSERT_EQ(array.readings().size(), 6U);
  const InfraredMeasurement& front = array.readings()[0];
  // 6787 / 44 + 3 = 157.25 counts: the nearest is 157.
  EXPECT_NEAR(front.volts, 157 * kCount, 1e-12);
  EXPECT_NEAR(front.metres, 67.87 / 154 - 0.04, 1e-12);
  EXPECT_TRUE(std::isnan(array.readings()[3].metres));
  EXPECT_NEAR(array.readings()[3].volts, 0.2, kCount);
}

TEST(Infrared, BothChannelsTellOfOneMeasurement) {
  World world(physics::WorldConfig{});
  face_wall(world, 0.4);
  const Proximity proximity(world);
  const auto sensors = physics::test::robertino().infrared;  // with noise
  const auto channels =
      simulated(sensors, {kRobot, "r0", 1, world, [&]() -> const Proximity& { return proximity; }});
  EXPECT_EQ(channels[0]->describe().name, "infrared");
  EXPECT_EQ(channels[1]->describe().name, "infrared_volts");
  for (int i = 0; i < 10; ++i) {
    const auto metres = channels[0]->sample(hal::Time{i * 100ms});
    const auto volts = channels[1]->sample(hal::Time{i * 100ms});
    ASSERT_TRUE(metres && volts);
    ASSERT_EQ(volts->size(), sensors.size());
    EXPECT_EQ(metres->at(0), sensors[0].curve.metres(volts->at(0))) << i;
  }
}

TEST(Infrared, ObliqueSensorsReadTheEdgeOfTheirSector) {
  World world(physics::WorldConfig{});
  face_wall(world, 0.2);
  const Proximity proximity(world);
  InfraredArray array(kRobot, quiet_sensors(), 1, "r0");
  array.sample(hal::Time{}, world, proximity);
  // Sensor at 60 degrees, x = 0.0925 m; wall at x = 0.385: the edge ray at 57.5 degrees is nearer.
  const double expected = (0.385 - 0.0925) / hal::math::cos(57.5 * hal::math::kPi / 180);
  // One count there is 67.87 / 120^2 = 5 mm.
  EXPECT_NEAR(array.readings()[1].metres, expected, 0.005);
  EXPECT_NEAR(array.readings()[5].metres, expected, 0.005);
}

TEST(Infrared, NoiseHasTheSigmaOfTheFile) {
  World world(physics::WorldConfig{});
  face_wall(world, 0.3);
  const Proximity proximity(world);
  auto sensors = physics::test::robertino().infrared;
  for (auto& sensor : sensors) {
    sensor.hold_period = {};
    sensor.converter.bits = 0;
  }
  InfraredArray array(kRobot, sensors, 1, "r0");
  double sum = 0;
  double squares = 0;
  constexpr int kSamples = 4000;
  const double exact = hal::node::devices::InfraredCurve::gp2d12().volts(0.3);
  for (int i = 0; i < kSamples; ++i) {
    array.sample(hal::Time{i * 1ms}, world, proximity);
    const double error = array.readings()[0].volts - exact;
    sum += error / kSamples;
    squares += error * error / kSamples;
  }
  // Mean within 4 sigma/sqrt(n) = 0.95 mV; sigma's own deviation is sigma/sqrt(2n) = 0.17 mV.
  EXPECT_NEAR(sum, 0, 0.00095);
  EXPECT_NEAR(std::sqrt(squares), 0.015, 0.0007);
}

/// Pearson's statistic of noise in units of `sigma`, over ten classes that a normal deviate falls
/// into equally often; the bounds are its deciles.
double chi_square(std::uint64_t seed, double sigma) {
  World world(physics::WorldConfig{});
  face_wall(world, 0.3);
  const Proximity proximity(world);
  auto sensors = physics::test::robertino().infrared;
  for (auto& sensor : sensors) {
    sensor.hold_period = {};
    sensor.converter.bits = 0;
  }
  InfraredArray array(kRobot, sensors, seed, "r0");
  const double exact = hal::node::devices::InfraredCurve::gp2d12().volts(0.3);
  constexpr std::array kDeciles{-1.281552, -0.841621, -0.524401, -0.253347, 0.0,
                                0.253347,  0.524401,  0.841621,  1.281552};
  std::array<int, 10> counts{};
  constexpr int kSamples = 10'000;
  for (int i = 0; i < kSamples; ++i) {
    array.sample(hal::Time{i * 1ms}, world, proximity);
    const double deviate = (array.readings()[0].volts - exact) / sigma;
    const auto above = std::upper_bound(kDeciles.begin(), kDeciles.end(), deviate);
    ++counts[static_cast<std::size_t>(above - kDeciles.begin())];
  }
  double sum = 0;
  for (const int count : counts) sum += (count - 1000.0) * (count - 1000.0) / 1000.0;
  return sum;
}

TEST(Infrared, NoiseIsNormal) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    const double statistic = chi_square(seed, 0.015);
    // Nine degrees of freedom: one in a thousand is above 27.88, one in a thousand below 1.15.
    EXPECT_LT(statistic, 27.88) << seed;
    EXPECT_GT(statistic, 1.15) << seed;
  }
}

TEST(Infrared, NoiseOfAnotherSigmaWouldBeNoticed) { EXPECT_GT(chi_square(1, 0.0165), 27.88); }

TEST(Infrared, ValueIsHeldBetweenTheInstantsOfASensor) {
  World world(physics::WorldConfig{});
  face_wall(world, 0.3);
  const Proximity proximity(world);
  InfraredArray array(kRobot, physics::test::robertino().infrared, 1, "r0");
  int changes = 0;
  double previous = -1;
  for (hal::Time t{}; t < hal::Time{3830ms}; t += 1ms) {
    array.sample(t, world, proximity);
    changes += array.readings()[0].volts != previous;
    previous = array.readings()[0].volts;
  }
  // 100 periods of 38.3 ms: the first value and 100 new ones, of which some fall on the same count
  // (sigma is 3 counts: about one in ten).
  EXPECT_LE(changes, 101);
  EXPECT_GE(changes, 80);
}

TEST(Infrared, ReadingOfAMovingRobotIsAsOldAsItsInstant) {
  World world(physics::WorldConfig{});
  face_wall(world, 1.5);
  Proximity proximity(world);
  auto sensors = quiet_sensors();
  sensors[0].converter.bits = 0;
  InfraredArray array(kRobot, sensors, 7, "r0");
  ASSERT_TRUE(world.set_body_velocity(kRobot, {0.3, 0, 0}));
  for (int k = 0; k < 300; ++k) world.step();
  std::vector<double> lags;  // s
  for (int tick = 0; tick < 18; ++tick) {
    for (int k = 0; k < 10; ++k) world.step();
    proximity.update();
    array.sample(world.now(), world, proximity);
    const double distance = 1.5 - world.pose(kRobot).position.x;
    lags.push_back((array.readings()[0].metres - distance) / 0.3);
  }
  const auto [youngest, oldest] = std::minmax_element(lags.begin(), lags.end());
  // 100 ms ticks step through the sensor's period of 38.3 ms; 0.1 ms is 0.03 mm of leaning.
  EXPECT_GT(*youngest, -1e-4);
  EXPECT_LT(*youngest, 0.010);
  EXPECT_GT(*oldest, 0.028);
  EXPECT_LT(*oldest, 0.0383 + 1e-4);
}

TEST(Infrared, SameSeedAndNameGiveTheSameBitsAndOthersDoNot) {
  World world(physics::WorldConfig{});
  face_wall(world, 0.3);
  const Proximity proximity(world);
  const auto volts = [&](std::uint64_t seed, const char* name) {
    InfraredArray array(kRobot, physics::test::robertino().infrared, seed, name);
    double sum = 0;
    for (hal::Time t{}; t < hal::Time{2s}; t += 100ms) {
      array.sample(t, world, proximity);
      sum += array.readings()[0].volts;
    }
    return sum;
  };
  EXPECT_EQ(volts(1, "r0"), volts(1, "r0"));
  EXPECT_NE(volts(1, "r0"), volts(2, "r0"));
  EXPECT_NE(volts(1, "r0"), volts(1, "r1"));
}

TEST(Localisation, OthersWithinRangeAppearInTheBodyFrame) {
  const std::vector<AgentPosition> agents{
      {AgentId{1}, {1, 1}}, {AgentId{2}, {1, 4}}, {AgentId{3}, {6, 1}}, {AgentId{4}, {1, 4.001}}};
  const auto found = localise({1, 1, hal::math::kPi / 2}, AgentId{1}, agents, 3);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].agent, AgentId{2});
  EXPECT_NEAR(found[0].position.x, 3, 1e-15);  // ahead: the body looks along y
  EXPECT_NEAR(found[0].position.y, 0, 1e-15);
  const auto left = localise({1, 1, 0}, AgentId{1}, agents, 5);
  ASSERT_EQ(left.size(), 3U);
  EXPECT_NEAR(left[0].position.y, 3, 1e-15);
  EXPECT_NEAR(left[1].position.x, 5, 1e-15);
}

}  // namespace
}  // namespace sim::sensing::test
