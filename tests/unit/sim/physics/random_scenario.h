#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "hal/types/math.h"
#include "hal/types/random.h"
#include "sim/physics/world.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::physics::test {

/// Robots, motes and walls drawn at random, driven at random for three seconds in a walled yard.
class RandomScenario {
 public:
  explicit RandomScenario(std::uint64_t seed)
      : random_(seed, "random scenario"), world_(drawn_config()) {
    wall_in();
    std::vector<int> cells(kSide * kSide);
    for (int i = 0; i < kSide * kSide; ++i) cells[static_cast<std::size_t>(i)] = i;
    for (std::size_t i = cells.size() - 1; i > 0; --i)
      std::swap(cells[i], cells[random_.below(static_cast<std::uint32_t>(i + 1))]);
    const std::size_t robots = 1 + random_.below(8);
    const std::size_t motes = random_.below(10);
    for (std::size_t i = 0; i < robots + motes + random_.below(5); ++i)
      fill(cells[i], i, robots, motes);
  }

  /// Runs the scenario, checking every step.
  void run() {
    while (world_.now() < hal::Time{std::chrono::seconds(3)}) {
      if (world_.steps() % 50 == 0) command();
      note_speeds();
      world_.step();
      check();
      if (testing::Test::HasFailure()) return;
    }
  }

  /// Whether anything was pushed into anything.
  bool had_contacts() const { return deepest_ > 0; }

 private:
  static constexpr int kSide = 7;
  static constexpr double kCell = 0.8;                    // m
  static constexpr double kHalfYard = kSide * kCell / 2;  // m

  double between(double a, double b) { return a + (b - a) * random_.uniform(); }

  WorldConfig drawn_config() {
    WorldConfig config;
    config.step = random_.below(4) == 0 ? std::chrono::milliseconds(5) : config.step;
    config.ground_friction = between(0.1, 1);
    config.seed = random_.next();
    return config;
  }

  void wall_in() {
    const double at = kHalfYard + 0.1;
    const double length = 2 * kHalfYard + 0.4;
    world_.add_wall({"east", {at, 0, 0.25}, {0.2, length, 0.5}});
    world_.add_wall({"west", {-at, 0, 0.25}, {0.2, length, 0.5}});
    world_.add_wall({"north", {0, at, 0.25}, {length, 0.2, 0.5}});
    world_.add_wall({"south", {0, -at, 0.25}, {length, 0.2, 0.5}});
  }

  /// One thing per cell of the yard, none reaching into the next.
  void fill(int cell, std::size_t i, std::size_t robots, std::size_t motes) {
    const double x = (cell % kSide + 0.5) * kCell - kHalfYard + between(-0.02, 0.02);
    const double y = (cell / kSide + 0.5) * kCell - kHalfYard + between(-0.02, 0.02);
    const hal::Pose2 pose{x, y, between(-hal::math::kPi, hal::math::kPi)};
    const AgentId agent{static_cast<std::uint16_t>(i + 1)};
    if (i < robots) {
      world_.add_robot(agent, drawn_robot(), pose);
    } else if (i < robots + motes) {
      const double side = between(0.03, 0.15);
      world_.add_mote(agent, {"mote", {side, side, between(0.03, 0.1)}, between(0.02, 1), 0.6},
                      pose);
    } else {
      world_.add_wall(
          {"box", {x, y, 0.25}, {between(0.05, 0.4), between(0.05, 0.4), 0.5}, pose.theta});
      return;
    }
    agents_.push_back(agent);
    if (i < robots) robots_.push_back(agent);
  }

  /// Three or four wheels, light to heavy, weak to strong, but not top-heavy.
  hal::node::devices::RobotDescription drawn_robot() {
    hal::node::devices::RobotDescription robot;
    using hal::node::devices::WheelLevel;
    robot.wheel_level = random_.below(2) == 0 ? WheelLevel::kJointed : WheelLevel::kContact;
    const double radius = between(0.12, 0.3);
    const double top = between(0.1, 0.8) * radius + 0.02;
    if (random_.below(3) == 0)
      robot.boxes = {
          {{1.3 * radius, 1.3 * radius, top - 0.02}, {0, 0, (top + 0.02) / 2}, 0, between(2, 20)}};
    else
      robot.cylinders = {{radius, 0.02, top, {}, between(2, 20)}};
    robot.friction = between(0, 0.6);
    const std::uint32_t wheels = 3 + random_.below(2);
    const double turn = between(0, 2);
    const hal::node::devices::Wheel common{{},
                                           0,
                                           between(0.025, 0.06),
                                           between(0.1, 0.5),
                                           between(0.3, 0.8),
                                           between(0, 0.05),
                                           between(0.1, 2),
                                           between(5, 30)};
    for (std::uint32_t i = 0; i < wheels; ++i) {
      hal::node::devices::Wheel wheel = common;
      wheel.axle_heading = turn + 2 * hal::math::kPi * i / wheels;
      wheel.position =
          0.8 * radius *
          hal::Vec2{hal::math::cos(wheel.axle_heading), hal::math::sin(wheel.axle_heading)};
      robot.wheels.push_back(wheel);
    }
    return robot;
  }

  void command() {
    for (const AgentId robot : robots_) {
      if (random_.below(20) == 0) {
        EXPECT_TRUE(world_.set_motors(robot, random_.below(2) == 0));
      }
      EXPECT_TRUE(
          world_.set_body_velocity(robot, {between(-1, 1), between(-1, 1), between(-3, 3)}));
    }
  }

  /// The two fastest points there were so far bound the speed at which bodies close.
  void note_speeds() {
    double first = 0, second = 0;
    for (const AgentId agent : agents_) {
      const BodyVelocity v = world_.velocity(agent);
      // No part of a body is farther than 0.4 m from its origin.
      const double speed =
          std::sqrt(hal::dot(v.linear, v.linear)) + 0.4 * std::sqrt(hal::dot(v.angular, v.angular));
      if (speed > first)
        second = std::exchange(first, speed);
      else
        second = std::max(second, speed);
    }
    closing_ = std::max(closing_, first + second);
  }

  void check() {
    for (const AgentId agent : agents_) {
      const hal::Vec3 p = world_.pose(agent).position;
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << agent.value;
      ASSERT_LT(std::max(std::abs(p.x), std::abs(p.y)), kHalfYard + 0.1) << agent.value;
      ASSERT_LT(std::abs(p.z), 0.5) << agent.value;  // m: neither sunk nor flung up
    }
    deepest_ = std::max(deepest_, world_.deepest_overlap());
    const double step = hal::to_seconds(world_.config().step);
    ASSERT_LE(world_.deepest_overlap(), closing_ * step + 0.005) << world_.steps();  // m
  }

  hal::RandomStream random_;
  World world_;
  std::vector<AgentId> agents_;
  std::vector<AgentId> robots_;
  double closing_ = 0;  ///< m/s
  double deepest_ = 0;  ///< m
};

}  // namespace sim::physics::test
