#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "hal/types/math.h"
#include "hal/types/random.h"
#include "sim/physics/overlap.h"
#include "sim/sensing/bumper.h"
#include "sim/sensing/imu.h"
#include "sim/sensing/pose_sensor.h"
#include "tests/unit/sim/physics/robertino.h"

/// Sensors that tell of the body itself: pose, touch, motion.
namespace sim::sensing::test {
namespace {

using hal::AgentId;
using hal::Vec3;
using hal::math::kPi;
using physics::World;
using physics::test::robertino;
using namespace std::chrono_literals;

constexpr AgentId kRobot{1};

const Proximity& unused() { throw std::logic_error("looks at nothing"); }

SensorSite site(const World& world) { return {kRobot, "r0", 1, world, unused}; }

double between(hal::RandomStream& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

TEST(PoseSensor, TellsThePoseIn10000RandomPlacements) {
  hal::RandomStream random(1, "placements");
  for (int k = 0; k < 10'000; ++k) {
    World world(physics::WorldConfig{});
    const hal::Pose2 pose{between(random, -1e3, 1e3), between(random, -1e3, 1e3),
                          between(random, -hal::math::kPi, hal::math::kPi)};
    world.add_robot(kRobot, physics::test::robertino(), pose);
    const auto values =
        simulated(hal::node::devices::PoseSensor{}, site(world))->sample(hal::Time{});
    ASSERT_TRUE(values);
    EXPECT_NEAR((*values)[0], pose.x, 1e-9);
    EXPECT_NEAR((*values)[1], pose.y, 1e-9);
    EXPECT_NEAR(hal::math::wrap_angle((*values)[2] - pose.theta), 0, 1e-12);
  }
}

TEST(PoseSensor, NoiseHasTheSigmasOfTheFile) {
  World world(physics::WorldConfig{});
  world.add_robot(kRobot, physics::test::robertino(), {1, 2, 3});
  hal::node::devices::PoseSensor description;
  description.position_sigma = 0.05;
  description.heading_sigma = 0.02;
  const auto sensor = simulated(description, site(world));
  std::array<double, 3> squares{};
  constexpr int kSamples = 4000;
  for (int k = 0; k < kSamples; ++k) {
    const auto v = *sensor->sample(hal::Time{} + k * 1ms);
    const std::array off{v[0] - 1, v[1] - 2, hal::math::wrap_angle(v[2] - 3)};
    for (std::size_t i = 0; i < 3; ++i) squares[i] += off[i] * off[i] / kSamples;
  }
  const double allowed = 4 / std::sqrt(2.0 * kSamples);
  EXPECT_NEAR(std::sqrt(squares[0]), 0.05, 0.05 * allowed);
  EXPECT_NEAR(std::sqrt(squares[1]), 0.05, 0.05 * allowed);
  EXPECT_NEAR(std::sqrt(squares[2]), 0.02, 0.02 * allowed);
}

TEST(PoseSensor, HoldsAFixForItsPeriod) {
  World world(physics::WorldConfig{});
  world.add_robot(kRobot, physics::test::robertino(), {});
  hal::node::devices::PoseSensor description;
  description.period = 1s;
  const auto sensor = simulated(description, site(world));
  int fixes = 0;
  for (int k = 0; k < 100; ++k) fixes += sensor->sample(hal::Time{} + k * 100ms) ? 1 : 0;
  EXPECT_NEAR(fixes, 10, 1);
}

TEST(Bumper, ClosesWhereTheBodyTouchesAWallIn10000RandomPlacements) {
  hal::RandomStream random(1, "touches");
  hal::node::devices::RobotDescription robot = physics::test::robertino();
  robot.wheel_level = hal::node::devices::WheelLevel::kContact;
  int pressed = 0;
  for (int k = 0; k < 10'000; ++k) {
    World world(physics::WorldConfig{});
    const double yaw = between(random, -hal::math::kPi, hal::math::kPi);
    world.add_wall({"wall", {0, 0, 0.5}, {0.4, 0.2, 1}, yaw});
    world.add_robot(kRobot, robot, {between(random, -0.5, 0.5), between(random, -0.5, 0.5), 0});
    const double depth = std::max(overlap(world.shapes()[0], world.shapes()[1]).level,
                                  overlap(world.shapes()[0], world.shapes()[2]).level);
    const auto sensor = simulated(hal::node::devices::Bumper{}, site(world));
    EXPECT_EQ(sensor->sample(hal::Time{})->front(), 0) << "nothing has happened yet";
    world.step();
    const bool told = sensor->sample(hal::Time{} + 10ms)->front() != 0;
    const bool clear_cut = std::abs(depth) > 1e-4;  // m; it settles by some um
    EXPECT_TRUE(!clear_cut || told == (depth > 0)) << depth;
    pressed += told ? 1 : 0;
  }
  EXPECT_GT(pressed, 1000);
  EXPECT_LT(pressed, 9000);
}

TEST(Bumper, OpensAgainWhenTheBodyIsFree) {
  World world(physics::WorldConfig{});
  world.add_wall({"wall", {0.5, 0, 0.5}, {0.2, 4, 1}, 0});
  world.add_robot(kRobot, physics::test::robertino(), {});
  const auto sensor = simulated(hal::node::devices::Bumper{}, site(world));
  ASSERT_TRUE(world.set_body_velocity(kRobot, {0.3, 0, 0}));
  for (int k = 0; k < 200; ++k) world.step();
  EXPECT_EQ(sensor->sample({})->front(), 1);
  ASSERT_TRUE(world.set_body_velocity(kRobot, {-0.3, 0, 0}));
  for (int k = 0; k < 200; ++k) world.step();
  EXPECT_EQ(sensor->sample({})->front(), 1) << "it was let go meanwhile, after the last reading";
  for (int k = 0; k < 10; ++k) world.step();
  EXPECT_EQ(sensor->sample({})->front(), 0);
}

TEST(Imu, TellsRotationAndCentripetalForceOf10000RandomCircles) {
  hal::RandomStream random(1, "circles");
  const Vec3 gravity{0, 0, -9.81};
  for (int k = 0; k < 10'000; ++k) {
    // A point on a circle of radius r at angle phi; the sensor's x axis is turned by psi from it.
    const double r = between(random, 0.1, 10), omega = between(random, -3, 3);
    const double phi = between(random, -hal::math::kPi, hal::math::kPi),
                 psi = between(random, -hal::math::kPi, hal::math::kPi);
    const double dt = between(random, 0.001, 0.2);
    const auto velocity = [&](double angle) {
      return Vec3{-r * omega * hal::math::sin(angle), r * omega * hal::math::cos(angle), 0};
    };
    const double heading = phi + psi;
    const auto values =
        inertial_values({velocity(phi - omega * dt), velocity(phi), {0, 0, omega}, gravity, dt},
                        {hal::math::cos(heading / 2), 0, 0, hal::math::sin(heading / 2)});
    // The mean over an arc is the chord: r omega^2 sin(omega dt / 2) / (omega dt / 2), inward.
    const double half = 0.5 * omega * dt;
    const double inward = r * omega * omega * hal::math::sin(half) / half;
    EXPECT_NEAR(values[2], omega, 1e-12);
    EXPECT_NEAR(values[3], -inward * hal::math::cos(psi), 1e-7 * std::max(1.0, inward));
    EXPECT_NEAR(values[4], inward * hal::math::sin(psi), 1e-7 * std::max(1.0, inward));
    EXPECT_NEAR(values[5], 9.81, 1e-12);
  }
}

TEST(Imu, AtRestTellsGravityInAnyAttitude) {
  hal::RandomStream random(1, "attitudes");
  for (int k = 0; k < 10'000; ++k) {
    // Pitched by p about y, then turned by h about z: gravity's reaction seen from the sensor.
    const double p = between(random, -1.5, 1.5),
                 h = between(random, -hal::math::kPi, hal::math::kPi);
    const double cp = hal::math::cos(p / 2), sp = hal::math::sin(p / 2);
    const double ch = hal::math::cos(h / 2), sh = hal::math::sin(h / 2);
    const std::array<double, 4> attitude{ch * cp, -sh * sp, ch * sp, sh * cp};
    const auto values = inertial_values({{}, {}, {}, {0, 0, -9.81}, 0.1}, attitude);
    EXPECT_NEAR(values[3], -9.81 * hal::math::sin(p), 1e-12);
    EXPECT_NEAR(values[4], 0, 1e-12);
    EXPECT_NEAR(values[5], 9.81 * hal::math::cos(p), 1e-12);
  }
}

TEST(Imu, OfADrivingRobotTellsItsTurnAndItsAcceleration) {
  World world(physics::WorldConfig{});
  world.add_robot(kRobot, physics::test::robertino(), {0, 0, 1});
  hal::node::devices::ImuSensor description;
  description.mount.heading = hal::math::kPi / 2;  // its x axis is the robot's y axis
  const auto sensor = simulated(description, site(world));
  for (int k = 0; k < 100; ++k) world.step();
  EXPECT_TRUE(sensor->sample({}));
  ASSERT_TRUE(world.set_body_velocity(kRobot, {0.8, 0, 0}));
  for (int k = 0; k < 50; ++k) world.step();
  const auto speeding = *sensor->sample({});
  EXPECT_NEAR(speeding[4], -0.8, 0.02) << "0.8 m/s^2 along the robot's x, its -y";  // m/s^2
  EXPECT_NEAR(speeding[5], 9.81, 0.02);
  ASSERT_TRUE(world.set_body_velocity(kRobot, {0.3, 0, 0.5}));
  for (int k = 0; k < 300; ++k) world.step();
  (void)sensor->sample({});
  for (int k = 0; k < 10; ++k) world.step();
  const auto turning = *sensor->sample({});
  EXPECT_NEAR(turning[2], 0.5, 0.002);       // rad/s
  EXPECT_NEAR(turning[3], 0.5 * 0.3, 0.01);  // m/s^2, to the left: its x
  EXPECT_FALSE(sensor->sample({})) << "no physics step since";
}

/// What an IMU tells of a robot at rest beyond what one without noise tells at the same instants,
/// value by value.
std::vector<std::array<double, 6>> noise_of(double gyro_sigma, double accelerometer_sigma,
                                            int samples) {
  World world(physics::WorldConfig{});
  world.add_robot(kRobot, physics::test::robertino(), {});
  hal::node::devices::ImuSensor description;
  const auto exact = simulated(description, site(world));
  description.gyro_sigma = gyro_sigma;
  description.accelerometer_sigma = accelerometer_sigma;
  const auto noisy = simulated(description, site(world));
  std::vector<std::array<double, 6>> noise(static_cast<std::size_t>(samples));
  for (auto& one : noise) {
    world.step();
    const auto true_values = *exact->sample({}), values = *noisy->sample({});
    for (std::size_t i = 0; i < 6; ++i) one[i] = values[i] - true_values[i];
  }
  return noise;
}

// With n independent normal values x of deviation sigma, the sum of (x / sigma)^2 has the mean n
// and the deviation sqrt(2 n), that of x / sigma the deviation sqrt(n), and so have the products of
// two axes, or of successive values. Allowed are four deviations each.
TEST(Imu, NoiseOfEachValueIsIndependentAndHasTheSigmaOfTheFile) {
  constexpr int kSamples = 4000;
  const double allowed = 4 * std::sqrt(double{kSamples});
  for (const auto& [gyro, accelerometer] : {std::pair(0.01, 0.05), {2.0, 0.003}}) {
    const auto noise = noise_of(gyro, accelerometer, kSamples);
    for (std::size_t i = 0; i < 6; ++i) {
      const auto at = [&, sigmas = std::pair(gyro, accelerometer)](std::size_t k,
                                                                   std::size_t axis) {
        return noise[k][axis] / (axis < 3 ? sigmas.first : sigmas.second);
      };
      const std::size_t next_axis = (i + 1) % 6;
      double sum = 0, squares = 0, across = 0, after = 0;
      for (std::size_t k = 0; k < noise.size(); ++k) {
        sum += at(k, i);
        squares += at(k, i) * at(k, i);
        across += at(k, i) * at(k, next_axis);
        if (k > 0) after += at(k, i) * at(k - 1, i);
      }
      EXPECT_NEAR(sum, 0, allowed) << i;
      EXPECT_NEAR(squares, kSamples, std::sqrt(2.0) * allowed) << i;
      EXPECT_NEAR(across, 0, allowed) << i;
      EXPECT_NEAR(after, 0, allowed) << i;
    }
  }
}

TEST(Imu, EachSigmaIsOfItsOwnInstrumentAndNoneIsNoNoise) {
  for (const bool gyro : {true, false}) {
    const auto noise = noise_of(gyro ? 0.01 : 0, gyro ? 0 : 0.05, 50);
    for (std::size_t i = 0; i < 6; ++i) {
      const bool has_noise = (i < 3) == gyro;
      for (const auto& one : noise) EXPECT_EQ(one[i] != 0, has_noise) << i;
    }
  }
}

}  // namespace
}  // namespace sim::sensing::test
