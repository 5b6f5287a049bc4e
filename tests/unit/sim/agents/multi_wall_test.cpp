// The multi-wall law over the walls of a world: closed forms on small floors, and 1000 random paths
// against another way to count.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "hal/types/random.h"
#include "sim/agents/populated_world.h"
#include "sim/agents/world_obstacles.h"
#include "sim/radio/channel/propagation.h"

namespace tests {
namespace {

using hal::Vec3;
using sim::agents::SimulationConfig;
using sim::agents::WorldObstacles;
using sim::physics::StaticBox;
using sim::radio::MultiWallConfig;

constexpr double kWavelength = 0.125;  // m
constexpr double kRounding = 1e-9;     // dB

/// A floor with a radio that has the law.
struct Floor {
  explicit Floor(const MultiWallConfig& law = {}) {
    config.radio = sim::radio::profile_defaults(sim::radio::Profile::kIeee80211n);
    waves().propagation.chain = {law};
    waves().propagation.wavelength = hal::Metres{kWavelength};
    waves().propagation.interference_floor = waves().receiver.sensitivity = hal::Dbm{-300};
  }
  sim::radio::WavesConfig& waves() { return *waves_of(config.radio); }

  /// A wall across the path along x. @param at  its middle, m. @param thickness, height  m
  void wall(double at, double thickness, const char* material, double height = 3) {
    config.walls.push_back({.name = "w",
                            .centre = {at, 0, height / 2},
                            .size = {thickness, 10, height},
                            .material = material});
  }

  /// dB from antenna to antenna.
  double loss(const Vec3& from, const Vec3& to) const {
    const auto world = sim::agents::populated_world(config);
    const WorldObstacles obstacles(*world, config);
    const sim::radio::Propagation propagation(config.radio, obstacles);
    const auto steady = propagation.steady(hal::Milliwatts{1}, from, to);
    return -10 * std::log10(steady.walls * steady.free.value);
  }
  double loss_along(double metres, double height = 1) const {
    return loss({0, 0, height}, {metres, 0, height});
  }

  SimulationConfig config;
};

double free_space(double metres) {
  return 20 * std::log10(4 * std::numbers::pi * metres / kWavelength);
}

TEST(MultiWall, IsFreeSpaceOnAnEmptyFloor) {
  EXPECT_NEAR(Floor().loss_along(25), free_space(25), kRounding);
}

TEST(MultiWall, HasItsConstantAndItsExponent) {
  const Floor floor(MultiWallConfig{.constant_loss = hal::Decibels{3}, .exponent = 2.8});
  EXPECT_NEAR(floor.loss_along(25), free_space(1) + 28 * std::log10(25) + 3, kRounding);
}

TEST(MultiWall, NeverLeavesMoreThanWasSent) {
  const Floor floor(MultiWallConfig{.constant_loss = hal::Decibels{-60}});
  EXPECT_NEAR(floor.loss_along(2), 0, kRounding);
}

TEST(MultiWall, AddsTheLossOfEachWallByItsMaterial) {
  Floor floor;
  floor.wall(3, 0.12, "brick");
  floor.wall(6, 0.12, "brick");
  floor.wall(9, 0.15, "concrete");
  EXPECT_NEAR(floor.loss_along(12), free_space(12) + 2 * 3.5 + 11.4, kRounding);
  EXPECT_NEAR(floor.loss_along(5), free_space(5) + 3.5, kRounding);
  floor.waves().phy.channel = 36;
  EXPECT_NEAR(floor.loss_along(12), free_space(12) + 2 * 4.2 + 20.2, kRounding) << "in 5 GHz";
}

TEST(MultiWall, CountsAThickWallOnce) {
  Floor floor;
  floor.wall(6, 4, "brick");
  EXPECT_NEAR(floor.loss_along(12), free_space(12) + 3.5, kRounding);
  EXPECT_NEAR(floor.loss_along(6), free_space(6) + 3.5, kRounding) << "an antenna inside it";
}

TEST(MultiWall, CountsTouchingBoxesOfOneMaterialOnce) {
  Floor floor;
  for (const double at : {4.0, 4.2, 4.35}) floor.wall(at, 0.2, "brick");  // touch, and overlap
  EXPECT_NEAR(floor.loss_along(12), free_space(12) + 3.5, kRounding);
  floor.wall(4.55 + 0.0005, 0.2, "brick");  // half a millimetre away: the same wall
  EXPECT_NEAR(floor.loss_along(12), free_space(12) + 3.5, kRounding);
  floor.wall(5, 0.2, "brick");  // 0.2495 m away
  EXPECT_NEAR(floor.loss_along(12), free_space(12) + 2 * 3.5, kRounding);
  floor.waves().propagation.chain = {MultiWallConfig{.gap = hal::Metres{0.3}}};
  EXPECT_NEAR(floor.loss_along(12), free_space(12) + 3.5, kRounding);
}

TEST(MultiWall, CountsTouchingBoxesOfTwoMaterialsAsTwoWalls) {
  Floor floor;
  floor.wall(4, 0.2, "brick");
  floor.wall(4.2, 0.2, "wood");
  floor.wall(4.4, 0.2, "brick");  // 0.2 m from the other
  EXPECT_NEAR(floor.loss_along(12), free_space(12) + 2 * 3.5 + 0.6, kRounding);
}

TEST(MultiWall, PassesOverAWall) {
  Floor floor;
  floor.wall(6, 0.2, "brick", 2);
  EXPECT_NEAR(floor.loss_along(12, 1.9), free_space(12) + 3.5, kRounding);
  EXPECT_NEAR(floor.loss_along(12, 2.1), free_space(12), kRounding);
  // From 1 m up to 3.4 m: 2.2 m high at the wall.
  EXPECT_NEAR(floor.loss({0, 0, 1}, {12, 0, 3.4}), free_space(std::hypot(12, 2.4)), kRounding);
}

TEST(MultiWall, CountsCeilingsByTheFormOfCost231) {
  Floor floor;
  floor.config.ceilings = {{hal::Metres{3}}, {hal::Metres{6}}, {hal::Metres{9}}};
  const auto over = [&](double top) {
    return floor.loss({0, 0, 1}, {0, 0, top}) - free_space(top - 1);
  };
  EXPECT_NEAR(over(2.5), 0, kRounding);
  EXPECT_NEAR(over(3), 0, kRounding) << "an antenna at the ceiling";
  EXPECT_NEAR(over(4), 18.3, kRounding);
  EXPECT_NEAR(over(7), 18.3 * std::pow(2, 4.0 / 3 - 0.46), kRounding);
  EXPECT_NEAR(over(10), 18.3 * std::pow(3, 5.0 / 4 - 0.46), kRounding);
  floor.config.ceilings[1].loss = hal::Decibels{10.3};  // mean of two: 14.3 dB
  EXPECT_NEAR(over(7), 14.3 * std::pow(2, 4.0 / 3 - 0.46), kRounding);
  floor.waves().propagation.chain = {
      MultiWallConfig{.ceiling_loss = hal::Decibels{20}, .ceiling_b = 0.5}};
  EXPECT_NEAR(over(7), 20 * std::pow(2, 4.0 / 3 - 0.5), kRounding);
}

TEST(MultiWall, TakesTheLossesOfTheWorldAndOfTheRadio) {
  Floor floor;
  floor.wall(3, 0.1, "brick");
  floor.wall(6, 0.1, "door");
  floor.config.materials = {{"door", hal::Decibels{2.25}, hal::Decibels{3}}};
  EXPECT_NEAR(floor.loss_along(12), free_space(12) + 3.5 + 2.25, kRounding);
  floor.waves().propagation.chain = {MultiWallConfig{.walls = {{"brick", hal::Decibels{8}}}}};
  EXPECT_NEAR(floor.loss_along(12), free_space(12) + 8 + 2.25, kRounding);
}

TEST(MultiWall, DoesNotCountWallsTwiceWithObstacles) {
  Floor floor;
  floor.wall(6, 0.2, "brick");
  const double alone = floor.loss_along(12);
  floor.waves().propagation.obstacles = true;
  EXPECT_EQ(floor.loss_along(12), alone);
  floor.waves().propagation.chain = {sim::radio::FriisConfig{}};
  EXPECT_NEAR(floor.loss_along(12), free_space(12) + 9 + 0.4 * 0.2, kRounding)
      << "without the law, the cut by radio_loss";
}

using Part = std::pair<double, double>;

/// The part of a segment inside a box, as shares of it: in the box's own frame, slab by slab.
Part part_in(const StaticBox& box, const Vec3& from, const Vec3& to) {
  const double c = std::cos(box.yaw), s = std::sin(box.yaw);
  const auto own = [&](const Vec3& p) {
    const Vec3 d = p - box.centre;
    return std::array{c * d.x + s * d.y, c * d.y - s * d.x, d.z};
  };
  const auto a = own(from), b = own(to);
  const std::array half{box.size.x / 2, box.size.y / 2, box.size.z / 2};
  Part part{0, 1};
  for (std::size_t k = 0; k < 3; ++k) {
    const double t1 = (-half[k] - a[k]) / (b[k] - a[k]);
    const double t2 = (half[k] - a[k]) / (b[k] - a[k]);
    part.first = std::max(part.first, std::min(t1, t2));
    part.second = std::min(part.second, std::max(t1, t2));
  }
  return part;
}

/// Number of parts that nothing before them reaches: each begins a wall.
int count(const std::vector<Part>& parts, double gap) {
  int walls = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    bool begins = true;
    for (std::size_t j = 0; j < parts.size(); ++j) {
      if (j == i) continue;
      const bool is_before =
          parts[j].first < parts[i].first || (parts[j].first == parts[i].first && j < i);
      begins = begins && !(is_before && parts[j].second + gap >= parts[i].first);
    }
    walls += begins ? 1 : 0;
  }
  return walls;
}

/// Rows of four to eight boxes that touch end to end, turned, of different heights and materials.
std::vector<StaticBox> rows_of_boxes(hal::RandomStream& random) {
  constexpr std::array kMaterials{"brick", "concrete", "wood"};
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  std::vector<StaticBox> walls;
  for (int row = 0; row < 60; ++row) {
    const double yaw = between(-3, 3), length = between(0.3, 1), height = between(1, 3);
    const Vec3 start{between(-20, 20), between(-20, 20), height / 2};
    const auto boxes = static_cast<int>(between(4, 9));
    for (int i = 0; i < boxes; ++i) {
      const Vec3 along{std::cos(yaw) * length * i, std::sin(yaw) * length * i, 0};
      walls.push_back({.name = "w",
                       .centre = start + along,
                       .size = {length, between(0.1, 0.6), height},
                       .yaw = yaw,
                       .material = kMaterials[row % kMaterials.size()]});
    }
  }
  return walls;
}

TEST(MultiWall, CrossesAsManyWallsOnRandomPathsAsAnotherCount) {
  SimulationConfig config;
  hal::RandomStream random(5, "floor");
  config.walls = rows_of_boxes(random);
  const auto world = sim::agents::populated_world(config);
  const WorldObstacles obstacles(*world, config);
  const auto materials = obstacles.materials();
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  constexpr hal::Metres kGap{1e-3};
  int crossed_in_all = 0, boxes_in_all = 0;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 from{between(-25, 25), between(-25, 25), between(0, 3)};
    const Vec3 to{between(-25, 25), between(-25, 25), between(0, 3)};
    const Vec3 way = to - from;
    const double length = std::sqrt(hal::dot(way, way));
    std::map<std::string, std::vector<Part>> parts;
    for (const StaticBox& wall : config.walls) {
      const Part part = part_in(wall, from, to);
      if (part.second <= part.first) continue;
      parts[wall.material].push_back(part);
      ++boxes_in_all;
    }
    sim::WallCrossings crossed;
    obstacles.crossings(from, to, kGap, crossed);
    ASSERT_EQ(crossed.walls.size(), materials.size());
    for (std::size_t m = 0; m < materials.size(); ++m) {
      const int expected = count(parts[materials[m].name], kGap.value / length);
      EXPECT_EQ(static_cast<int>(crossed.walls[m]), expected) << k << ' ' << materials[m].name;
      crossed_in_all += expected;
    }
  }
  EXPECT_GT(crossed_in_all, 1500) << "the case must be tried";
  EXPECT_GT(boxes_in_all, crossed_in_all + 100) << "so must merging";
}

}  // namespace
}  // namespace tests
