#include "sim/agents/world_obstacles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hal/types/math.h"
#include "hal/types/random.h"
#include "sim/agents/populated_world.h"
#include "tests/unit/sim/agents/two_motes.h"
#include "tests/unit/sim/physics/robertino.h"

namespace tests {
namespace {

using hal::Vec3;
using sim::agents::WorldObstacles;

/// m of a segment inside a box: in the box's own frame, slab by slab.
double way_inside(const sim::physics::StaticBox& box, const Vec3& from, const Vec3& to) {
  const double c = hal::math::cos(box.yaw), s = hal::math::sin(box.yaw);
  const auto own = [&](const Vec3& p) {
    const Vec3 d = p - box.centre;
    return std::array{c * d.x + s * d.y, c * d.y - s * d.x, d.z};
  };
  const auto a = own(from), b = own(to);
  const double half[] = {box.size.x / 2, box.size.y / 2, box.size.z / 2};
  double enter = 0, leave = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double t1 = (-half[k] - a[k]) / (b[k] - a[k]);
    const double t2 = (half[k] - a[k]) / (b[k] - a[k]);
    enter = std::max(enter, std::min(t1, t2));
    leave = std::min(leave, std::max(t1, t2));
  }
  const Vec3 way = to - from;
  return leave > enter ? (leave - enter) * std::sqrt(hal::dot(way, way)) : 0;
}

// 1000 placements of antennas among 30 walls of different size, turn and loss. dB: rounding only.
TEST(WorldObstacles, LoseWhatAnIndependentIntersectionSays) {
  SimulationConfig config;
  hal::RandomStream random(3, "walls");
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  for (int i = 0; i < 30; ++i) {
    const double height = between(0.5, 3);
    config.walls.push_back({.name = "w",
                            .centre = {between(-30, 30), between(-30, 30), height / 2},
                            .size = {between(1, 20), between(0.1, 2), height},
                            .yaw = between(-3, 3),
                            .radio_loss = {hal::Decibels{between(0, 20)}, between(0, 5)}});
  }
  const auto world = populated_world(config);
  const WorldObstacles obstacles(*world, config);
  int crossed = 0;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 from{between(-35, 35), between(-35, 35), between(0, 3)};
    const Vec3 to{between(-35, 35), between(-35, 35), between(0, 3)};
    double expected = 0;
    for (const auto& wall : config.walls) {
      const double metres = way_inside(wall, from, to);
      if (metres <= 0) continue;
      expected += wall.radio_loss.per_crossing.value + wall.radio_loss.per_metre * metres;
      ++crossed;
    }
    EXPECT_NEAR(obstacles.loss(from, to).value, expected, 1e-9) << k;
    EXPECT_NEAR(obstacles.loss(to, from).value, expected, 1e-9) << k;
  }
  EXPECT_GT(crossed, 500) << "the case must be tried";
}

// A Robertino, 0.37 m wide up to 0.21 m, drives along x = 0 between two antennas at x = -3 and 3 m.
TEST(WorldObstacles, BodiesCountWhereTheyAreNowButNotTheEndsOwn) {
  SimulationConfig config;
  sim::radio::RadioConfig air;
  waves_of(air)->propagation.body_loss = {hal::Decibels{5}, 10};
  config.radio = air;
  config.agents.push_back({.id = kA,
                           .name = "a",
                           .pose = {0, -1, 0},
                           .body = sim::physics::test::robertino(),
                           .program = {},
                           .parameters = {}});
  const auto world = populated_world(config);
  const WorldObstacles obstacles(*world, config);
  const auto loss = [&](hal::AgentId one) {
    return obstacles.moving_loss({one, {-3, 0, 0.1}}, {hal::AgentId{9}, {3, 0, 0.1}}).value;
  };
  EXPECT_EQ(loss(kB), 0) << "it is beside the way";
  (void)world->set_body_velocity(kA, {0, 0.4, 0});
  double most = 0;
  for (int i = 0; i < 600; ++i) {
    world->step();
    most = std::max(most, loss(kB));
    EXPECT_EQ(loss(kA), 0) << "its own antenna's";
  }
  EXPECT_NEAR(most, 5 + 10 * 0.37, 0.05);  // dB: its diameter
  EXPECT_EQ(loss(kB), 0) << "it has passed";
}

// The robot pushes a steel ball of 0.4 m across the way; bodies of agents do not attenuate.
TEST(WorldObstacles, MovablesCountWhereTheyAreNow) {
  SimulationConfig config;
  config.agents.push_back({.id = kA,
                           .name = "a",
                           .pose = {0, -1.5, 0},
                           .body = sim::physics::test::robertino(),
                           .program = {},
                           .parameters = {}});
  sim::physics::Movable glass{.name = "glass", .form = sim::physics::MovableBox{{9, 9, 1}}};
  sim::physics::Movable ball{.name = "ball", .form = sim::physics::MovableSphere{0.2}};
  glass.pose.x = 50;
  ball.pose.y = -1;
  ball.rolling_resistance = 1;
  ball.radio_loss = {hal::Decibels{20}, 10};
  config.movables = {glass, ball};
  const auto world = populated_world(config);
  const WorldObstacles obstacles(*world, config);
  EXPECT_TRUE(obstacles.has_movables());
  const auto loss = [&] {
    return obstacles.moving_loss({kB, {-3, 0, 0.2}}, {hal::AgentId{9}, {3, 0, 0.2}}).value;
  };
  EXPECT_EQ(loss(), 0) << "it is beside the way";
  (void)world->set_body_velocity(kA, {0, 0.4, 0});
  double most = 0;
  for (int i = 0; i < 600; ++i) {
    world->step();
    most = std::max(most, loss());
  }
  EXPECT_NEAR(most, 20 + 10 * 0.4, 0.05);  // dB: its diameter
  EXPECT_EQ(loss(), 0) << "it has passed";
  config.movables = {glass};
  EXPECT_FALSE(WorldObstacles(*populated_world(config), config).has_movables());
}

/// A row of motes, 10 m apart, with a wall between the third and the fourth, 1 m high.
SimulationConfig divided(double thickness) {
  SimulationConfig config;
  config.radio = sim::radio::profile_defaults(sim::radio::Profile::kIeee80211b);
  config.walls.push_back(
      {.name = "w", .centre = {25, 0, 0.5}, .size = {thickness, 40, 1}, .radio_loss = {}});
  for (std::uint16_t i = 0; i < 6; ++i) {
    config.agents.push_back({.id = hal::AgentId{static_cast<std::uint16_t>(i + 1)},
                             .name = "m" + std::to_string(i),
                             .pose = {10.0 * i, 0, 0},
                             .body = hal::node::devices::MoteDescription{},
                             .program = {},
                             .parameters = {}});
  }
  return config;
}

/// What the run says of them at its start.
std::size_t links(const SimulationConfig& config) {
  class Start final : public sim::agents::Observer {
   public:
    void on_start(const std::vector<std::pair<AgentId, AgentId>>& pairs) override {
      links = pairs.size();
    }
    std::size_t links = 0;
  } start;
  std::vector<AgentId> all;
  for (const auto& agent : config.agents) all.push_back(agent.id);
  sim::agents::Simulation simulation(config, {&start});
  simulation.connect(std::make_shared<ScriptedPort>(nothing), all, {});
  NoPace pace;
  (void)simulation.run(Time{1ms}, pace);
  return start.links;
}

// 40 mW at 2.412 GHz reach 779 m in the open: all 15 pairs. 60 dB take the reach to 0.8 m: the nine
// pairs across the wall go.
TEST(WorldObstacles, CutLinksThroughAWallAndOnlyThose) {
  SimulationConfig config = divided(1);
  config.walls[0].radio_loss = {hal::Decibels{60}, 0};
  EXPECT_EQ(links(config), 15u) << "without `obstacles`";
  waves_of(config.radio)->propagation.obstacles = true;
  EXPECT_EQ(links(config), 6u);
  config.walls[0].radio_loss = {hal::Decibels{0}, 60};
  EXPECT_EQ(links(config), 6u) << "60 dB/m, 1 m thick";
  config.walls[0].radio_loss = {hal::Decibels{3}, 2};
  EXPECT_EQ(links(config), 15u) << "5 dB do not matter so near";
}

TEST(WorldObstacles, DoNotMatterToAntennasAboveThem) {
  SimulationConfig config = divided(1);
  config.walls[0].radio_loss = {hal::Decibels{60}, 0};
  waves_of(config.radio)->propagation.obstacles = true;
  waves_of(config.radio)->propagation.antenna_height = hal::Metres{1.5};
  EXPECT_EQ(links(config), 15u);
  config.agents[2].radio.antenna_height = hal::Metres{0.1};
  EXPECT_EQ(links(config), 12u) << "those of the low one";
}

}  // namespace
}  // namespace tests
