#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "hal/types/math.h"
#include "hal/types/random.h"
#include "sim/sensing/proximity.h"
#include "tests/unit/sim/physics/robertino.h"

/// What a sensor sees in worlds of walls, boxes, motes and cylindrical robots, against a closed
/// form that works on outlines cut into the sector's edges, in long double.
namespace sim::sensing::test {
namespace {

using hal::AgentId;
using hal::math::kPi;
using Real = long double;

constexpr int kScenes = 1000;
constexpr int kLooks = 10;  ///< Per scene.
constexpr double kReach = 1.5;

struct Point {
  Real x = 0, y = 0;
};
Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
Real cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
Real dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
Real length(Point a) { return std::sqrt(dot(a, a)); }

Point unit(double heading) { return {hal::math::cos(heading), hal::math::sin(heading)}; }

struct Look {
  Point left, right;  ///< Edges of the sector, unit vectors; it is narrower than half a turn.
  bool holds(Point p) const { return cross(right, p) >= 0 && cross(p, left) >= 0; }
};

using Range = std::optional<Real>;

void offer(Range& best, Real distance) {
  if (distance <= kReach && (!best || distance < *best)) best = distance;
}

/// Where the edge ray from the origin meets the segment a-b.
void offer_ray(Range& best, Point ray, Point a, Point b) {
  const Point along = b - a;
  const Real slope = cross(ray, along);
  if (slope == 0) return;
  const Real distance = cross(a, along) / slope;
  const Real share = cross(a, ray) / slope;
  if (distance >= 0 && share >= 0 && share <= 1) offer(best, distance);
}

struct Outline {
  bool is_round = false;
  Point centre;
  Real radius = 0;
  std::array<Point, 4> corners{};
};

void offer_disc(Range& best, const Look& look, const Outline& disc) {
  if (look.holds(disc.centre)) offer(best, length(disc.centre) - disc.radius);
  for (const Point ray : {look.left, look.right}) {
    const Real beside = cross(ray, disc.centre);
    const Real half = disc.radius * disc.radius - beside * beside;
    const Real ahead = dot(ray, disc.centre);
    if (half >= 0 && ahead > 0) offer(best, ahead - std::sqrt(half));
  }
}

void offer_box(Range& best, const Look& look, const Outline& box) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Point a = box.corners[i];
    const Point b = box.corners[(i + 1) % 4];
    for (const Point ray : {look.left, look.right}) offer_ray(best, ray, a, b);
    if (look.holds(a)) offer(best, length(a));
    const Real foot = -dot(a, b - a) / dot(b - a, b - a);
    const Point nearest{a.x + foot * (b.x - a.x), a.y + foot * (b.y - a.y)};
    if (foot > 0 && foot < 1 && look.holds(nearest)) offer(best, length(nearest));
  }
}

bool surrounds(const Outline& outline) {
  if (outline.is_round) return length(outline.centre) <= outline.radius;
  for (std::size_t i = 0; i < 4; ++i) {
    const Point a = outline.corners[i];
    if (cross(outline.corners[(i + 1) % 4] - a, Point{} - a) < 0) return false;
  }
  return true;
}

/// A world, and the same outlines relative to the sensor in its origin.
class Scene {
 public:
  explicit Scene(hal::RandomStream& random) : random_(random), world_(physics::WorldConfig{}) {
    add_wall(between(1, 5), 0.15);
    add_wall(between(0.05, 0.4), between(0.05, 0.4));
    for (int i = 0; i < 3; ++i) add_mote();
    for (int i = 0; i < 2; ++i) add_robot();
  }

  const physics::World& world() const { return world_; }
  bool buries_the_sensor() const {
    return std::any_of(outlines_.begin(), outlines_.end(), surrounds);
  }
  Range nearest(const Look& look) const {
    Range best;
    for (const Outline& outline : outlines_)
      outline.is_round ? offer_disc(best, look, outline) : offer_box(best, look, outline);
    return best;
  }

 private:
  double between(double a, double b) { return a + (b - a) * random_.uniform(); }
  AgentId next() { return AgentId{++last_}; }

  void outline_box(hal::Vec2 centre, double half_x, double half_y, double yaw) {
    const Point u = unit(yaw);
    Outline outline;
    const std::array<std::array<int, 2>, 4> signs{{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
    for (std::size_t i = 0; i < 4; ++i) {
      const Real a = signs[i][0] * half_x, b = signs[i][1] * half_y;
      outline.corners[i] = {centre.x + a * u.x - b * u.y, centre.y + a * u.y + b * u.x};
    }
    outlines_.push_back(outline);
  }
  void add_wall(double half_x, double half_y) {
    const hal::Vec2 at{between(-2, 2), between(-2, 2)};
    const double yaw = between(-hal::math::kPi, hal::math::kPi);
    world_.add_wall({"wall", {at.x, at.y, 0.5}, {2 * half_x, 2 * half_y, 1}, yaw});
    outline_box(at, half_x, half_y, yaw);
  }
  void add_mote() {
    const hal::Pose2 pose{between(-1, 1), between(-1, 1), between(-hal::math::kPi, hal::math::kPi)};
    world_.add_mote(next(), {}, pose);
    outline_box({pose.x, pose.y}, 0.025, 0.025, pose.theta);
  }
  void add_robot() {
    hal::node::devices::RobotDescription robot = physics::test::robertino();
    robot.cylinders = {{between(0.1, 0.4), 0.02, 0.2, {}, 5}};
    const hal::Pose2 pose{between(-2, 2), between(-2, 2), between(-hal::math::kPi, hal::math::kPi)};
    world_.add_robot(next(), robot, pose);
    Outline outline;
    outline.is_round = true;
    outline.centre = {pose.x, pose.y};
    outline.radius = robot.cylinders[0].radius;
    outlines_.push_back(outline);
  }

  hal::RandomStream& random_;
  physics::World world_;
  std::vector<Outline> outlines_;
  std::uint16_t last_ = 0;
};

struct Tally {
  int seen = 0, unseen = 0;
};

void look_around(const Scene& scene, hal::RandomStream& random, Tally& tally) {
  const Proximity proximity(scene.world());
  for (int i = 0; i < kLooks; ++i) {
    const double heading = 2 * hal::math::kPi * random.uniform() - hal::math::kPi;
    const double half = random.below(2) == 0 ? 2.5 * hal::math::kPi / 180 : 0.01 + random.uniform();
    const Look look{unit(heading + half), unit(heading - half)};
    const Range expected = scene.nearest(look);
    const auto range = proximity.nearest({{0, 0, 0.04}, heading, half, kReach}, AgentId{1000});
    ASSERT_EQ(range.has_value(), expected.has_value()) << heading;
    ++(range ? tally.seen : tally.unseen);
    if (!range) continue;
    EXPECT_NEAR(*range, static_cast<double>(*expected), 1e-9) << heading;  // m
  }
}

TEST(Placements, TenThousandLooksAgreeWithTheClosedForm) {
  hal::RandomStream random(3, "placements");
  Tally tally;
  for (int i = 0; i < kScenes;) {
    const Scene scene(random);
    if (scene.buries_the_sensor()) continue;
    SCOPED_TRACE(i++);
    look_around(scene, random, tally);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_EQ(tally.seen + tally.unseen, 10'000);
  EXPECT_GT(tally.seen, 3000);
  EXPECT_GT(tally.unseen, 1000);
}

}  // namespace
}  // namespace sim::sensing::test
