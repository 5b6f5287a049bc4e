#include "sim/sensing/scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "hal/types/math.h"
#include "hal/types/random.h"
#include "sim/sensing/sector_query.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::sensing::test {
namespace {

using hal::AgentId;
using hal::Vec2;
using hal::math::kPi;
using hal::node::devices::ScanSensor;
using physics::Shape;
using physics::World;
using namespace std::chrono_literals;

constexpr AgentId kRobot{1};
constexpr double kFar = std::numeric_limits<double>::infinity();

double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// Where a ray meets a line segment: |origin + t direction| on it, t >= 0; by Cramer's rule.
double to_segment(Vec2 origin, Vec2 direction, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double determinant = cross(direction, along);
  if (determinant == 0) return kFar;
  const double t = cross(a - origin, along) / determinant;
  const double u = cross(a - origin, direction) / determinant;
  return t >= 0 && u >= 0 && u <= 1 ? t : kFar;
}

/// The least non-negative root of |origin + t direction - centre| = radius.
double to_circle(Vec2 origin, Vec2 direction, Vec2 centre, double radius) {
  const Vec2 to = origin - centre;
  const double b = hal::dot(to, direction), c = hal::dot(to, to) - radius * radius;
  if (b * b < c) return kFar;
  const double root = std::sqrt(b * b - c);
  if (-b - root >= 0) return -b - root;
  return -b + root >= 0 ? -b + root : kFar;
}

/// The reference: outlines only, by other formulas than the ones under test.
double closed_form(const Shape& shape, Vec2 origin, Vec2 direction) {
  if (shape.kind == Shape::Kind::kCylinder)
    return to_circle(origin, direction, shape.centre, shape.radius);
  const Vec2 x = shape.half.x * shape.axis;
  const Vec2 y = shape.half.y * Vec2{-shape.axis.y, shape.axis.x};
  const std::array corners{shape.centre + x + y, shape.centre - x + y, shape.centre - x - y,
                           shape.centre + x - y};
  double nearest = kFar;
  for (std::size_t i = 0; i < 4; ++i)
    nearest = std::min(nearest, to_segment(origin, direction, corners[i], corners[(i + 1) % 4]));
  return nearest;
}

bool is_within(const Shape& shape, Vec2 point) {
  const Vec2 to = point - shape.centre;
  if (shape.kind == Shape::Kind::kCylinder) return hal::dot(to, to) <= shape.radius * shape.radius;
  return std::abs(hal::dot(to, shape.axis)) <= shape.half.x &&
         std::abs(cross(shape.axis, to)) <= shape.half.y;
}

class Random {
 public:
  double between(double low, double high) { return low + (high - low) * random_.uniform(); }
  Shape shape() {
    Shape shape;
    shape.kind = random_.uniform() < 0.5 ? Shape::Kind::kBox : Shape::Kind::kCylinder;
    shape.centre = {between(-5, 5), between(-5, 5)};
    shape.axis = unit(between(-hal::math::kPi, hal::math::kPi));
    shape.half = {between(0.01, 2), between(0.01, 2)};
    shape.radius = between(0.01, 1);
    shape.z_low = between(-0.5, 0.3);
    shape.z_high = shape.z_low + between(0.01, 1);
    return shape;
  }

 private:
  hal::RandomStream random_{1, "scan"};
};

TEST(RayRanges, AreThoseOfTheClosedFormIn10000RandomPlacements) {
  Random random;
  int hits = 0, within = 0;
  for (int k = 0; k < 10'000; ++k) {
    std::vector<Shape> shapes;
    for (int i = 0; i < 4; ++i) shapes.push_back(random.shape());
    const hal::Vec3 origin{random.between(-3, 3), random.between(-3, 3), random.between(0, 0.5)};
    std::vector<Vec2> directions;
    for (int i = 0; i < 8; ++i)
      directions.push_back(unit(random.between(-hal::math::kPi, hal::math::kPi)));
    std::vector<std::size_t> all(shapes.size());
    std::iota(all.begin(), all.end(), 0);
    const auto ranges = ray_ranges(origin, directions, shapes, all, kRobot);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      double expected = kFar;
      for (const Shape& shape : shapes) {
        if (origin.z < shape.z_low || origin.z > shape.z_high) continue;
        const Vec2 from{origin.x, origin.y};
        expected = std::min(expected,
                            is_within(shape, from) ? 0 : closed_form(shape, from, directions[i]));
      }
      if (expected == kFar) {
        EXPECT_EQ(ranges[i], kFar);
      } else {
        EXPECT_NEAR(ranges[i], expected, 1e-9 * std::max(1.0, expected));  // m
      }
      hits += expected < kFar ? 1 : 0;
      within += expected == 0 ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 10'000) << "of 80,000 rays: the test looks at something";
  EXPECT_GT(within, 100);
}

ScanSensor scanner() {
  ScanSensor scan;
  scan.mount.position = {0, 0, 0.15};
  scan.field = 2 * hal::math::kPi;
  scan.rays = 4;
  scan.min_range = 0.3;
  scan.max_range = 3;
  return scan;
}

/// A scanner in a world with walls 0.5 m ahead, 2 m to the left, 5 m behind and 0.2 m to the right
/// of its robot's middle.
struct Room {
  explicit Room(const ScanSensor& scan) : world(physics::WorldConfig{}) {
    world.add_wall({"ahead", {1.5, 0, 0.5}, {2, 0.1, 1}, 0});
    world.add_wall({"left", {0, 3, 0.5}, {0.1, 2, 1}, 0});
    world.add_wall({"behind", {-6, 0, 0.5}, {2, 0.1, 1}, 0});
    world.add_wall({"right", {0, -0.71, 0.5}, {0.02, 1.02, 1}, 0});
    world.add_robot(kRobot, physics::test::robertino(), {});
    proximity.emplace(world);
    sensor = simulated(
        scan, {kRobot, "r0", 1, world, [this]() -> const Proximity& { return *proximity; }});
  }
  World world;
  std::optional<Proximity> proximity;
  std::unique_ptr<hal::node::devices::Sensor> sensor;
};

TEST(Scan, TellsWallsNothingAndTooNear) {
  Room room(scanner());
  const auto values = room.sensor->sample(hal::Time{});  // behind, right, ahead, left
  ASSERT_TRUE(values);
  ASSERT_EQ(values->size(), room.sensor->describe().length);
  EXPECT_TRUE(std::isnan((*values)[0]));
  EXPECT_EQ((*values)[1], -kFar);
  EXPECT_NEAR((*values)[2], 0.5, 1e-9);
  EXPECT_NEAR((*values)[3], 2, 1e-9);
}

TEST(Scan, LooksWhereItsMountSays) {
  ScanSensor scan = scanner();
  scan.mount.heading = hal::math::kPi / 2;
  scan.mount.position = {0.1, 0.2, 0.15};
  scan.field = hal::math::kPi;  // rays at -90, -30, 30, 90 degrees from the left
  Room room(scan);
  const auto values = room.sensor->sample(hal::Time{});
  ASSERT_TRUE(values);
  EXPECT_TRUE(std::isnan((*values)[0])) << "the wall ahead is only 0.1 m wide";
  scan.mount.position = {0.1, 0, 0.15};
  Room ahead(scan);
  const auto from_ahead = ahead.sensor->sample(hal::Time{});
  EXPECT_NEAR((*from_ahead)[0], 0.4, 1e-9);
}

TEST(Scan, HoldsBetweenTwoScans) {
  ScanSensor scan = scanner();
  scan.period = 200ms;
  Room room(scan);
  int scans = 0;
  for (int k = 0; k < 100; ++k)
    scans += room.sensor->sample(hal::Time{} + k * 50ms).has_value() ? 1 : 0;
  EXPECT_NEAR(scans, 25, 1) << "5 s at 5 Hz";
}

TEST(Scan, NoiseHasTheSigmaOfTheFile) {
  ScanSensor scan = scanner();
  scan.noise_sigma = 0.02;
  Room room(scan);
  double sum = 0, squares = 0;
  constexpr int kSamples = 4000;
  for (int k = 0; k < kSamples; ++k) {
    const double range = (*room.sensor->sample(hal::Time{} + k * 1ms))[3];
    sum += range - 2;
    squares += (range - 2) * (range - 2);
  }
  EXPECT_NEAR(sum / kSamples, 0, 4 * 0.02 / std::sqrt(kSamples));
  EXPECT_NEAR(std::sqrt(squares / kSamples), 0.02, 4 * 0.02 / std::sqrt(2.0 * kSamples));
}

TEST(ScanSensor, FullTurnDoesNotRepeatItsFirstRay) {
  ScanSensor scan = scanner();
  scan.rays = 360;
  const auto turn = scan.headings();
  EXPECT_NEAR(turn.front(), -kPi, 1e-12);
  EXPECT_NEAR(turn.back(), kPi - kPi / 180, 1e-12);
  scan.field = hal::math::kPi;
  scan.rays = 181;
  const auto half = scan.headings();
  EXPECT_NEAR(half.front(), -kPi / 2, 1e-12);
  EXPECT_NEAR(half.back(), kPi / 2, 1e-12);
  EXPECT_NEAR(half[90], 0, 1e-12);
  scan.rays = 1;
  EXPECT_EQ(scan.headings(), std::vector{0.0});
}

}  // namespace
}  // namespace sim::sensing::test
