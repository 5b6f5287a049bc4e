#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/node/devices/motor_profile.h"
#include "hal/types/random.h"
#include "tests/unit/controllers/help_robot/robot_bench.h"

namespace {

using namespace std::chrono_literals;
using hal::Vec2;

constexpr double kPi = 3.14159265358979323846;
constexpr double kBodyRadius = 0.185;  // m
constexpr double kReach = 0.8;         // m, of the infrared sensors
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec2 rotated(Vec2 v, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// An upright box.
struct Box {
  Vec2 centre;
  double half_x = 0, half_y = 0;  ///< m, along its own axes.
  double yaw = 0;

  Vec2 inside(Vec2 world) const { return rotated(world - centre, -yaw); }

  /// Distance from a point to the surface; 0 inside.
  double distance(Vec2 point) const {
    const Vec2 p = inside(point);
    return std::hypot(std::max(std::abs(p.x) - half_x, 0.0), std::max(std::abs(p.y) - half_y, 0.0));
  }

  /// Distance from a point to where a ray enters the box; infinite if it does not.
  double along(Vec2 from, double heading) const {
    const Vec2 p = inside(from);
    const Vec2 d = rotated({1, 0}, heading - yaw);
    double enter = 0;
    double leave = kInfinity;
    const auto slab = [&](double position, double direction, double half) {
      const double a = (-half - position) / direction;
      const double b = (half - position) / direction;
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    };
    slab(p.x, d.x, half_x);
    slab(p.y, d.y, half_y);
    return enter <= leave ? enter : kInfinity;
  }
};

/// How real the robot is.
struct Realism {
  const char* name;
  hal::node::devices::AccelerationLimits acceleration;
  double noise = 0;  ///< m, standard deviation of a range.
};

/// The wall of the case study.
constexpr Box kWall{.centre = {12.2, 12.2}, .half_x = 0.15, .half_y = 10, .yaw = kPi / 4};

struct Passage {
  const char* name;
  Vec2 start;
  Vec2 hop;
  Box obstacle = kWall;
};

/// A plane with one obstacle and the robot, moved by its commands.
class World {
 public:
  World(const Passage& passage, const Realism& realism, double heading)
      : noise_(realism.noise),
        obstacle_(passage.obstacle),
        position_(passage.start),
        hop_(passage.hop),
        heading_(heading),
        motors_(realism.acceleration) {}

  /// Ten steps of 10 ms, the length of a control cycle.
  void move(const hal::Twist2& command) {
    for (int i = 0; i < 10; ++i) {
      const hal::Twist2 twist = motors_.advance(command, 10ms);
      position_ = position_ + 0.01 * rotated({twist.vx, twist.vy}, heading_);
      heading_ += 0.01 * twist.omega;
      clearance_ = std::min(clearance_, obstacle_.distance(position_));
    }
  }

  /// Least of three rays over the half angle of 2.5 degrees.
  std::vector<double> ranges() {
    std::vector<double> ranges;
    for (int i = 0; i < 6; ++i) {
      const double heading = heading_ + i * kPi / 3;
      const Vec2 rim = position_ + rotated({kBodyRadius, 0}, heading);
      double range = kInfinity;
      for (const double off : {-2.5, 0.0, 2.5}) {
        range = std::min(range, obstacle_.along(rim, heading + off * kPi / 180));
      }
      range += noise_ * random_.normal();
      ranges.push_back(range < kReach ? std::max(range, 0.10) : kNan);
    }
    return ranges;
  }

  Vec2 hop_in_body_frame() const { return rotated(hop_ - position_, -heading_); }
  double distance_to_hop() const { return std::hypot(hop_.x - position_.x, hop_.y - position_.y); }
  double clearance() const { return clearance_; }  ///< Least so far, from the centre. m

 private:
  double noise_;
  Box obstacle_;
  Vec2 position_;
  Vec2 hop_;
  double heading_;
  hal::node::devices::MotorProfile motors_;
  double clearance_ = kInfinity;
  hal::RandomStream random_{1, "ranges"};
};

/// Drives help_robot to its hop. @return the time it took; nothing: not there after two minutes.
std::optional<double> drive_to_hop(World& world) {
  tests::RobotBench bench;
  bench.agent->start();
  bench.hear(17, controllers::HelpWord::kHelp);
  bench.control();
  bench.learn(17, 6, 3);
  bench.hear(17, controllers::HelpWord::kGrant);
  hal::Twist2 command;
  for (int cycle = 0; cycle < 1200; ++cycle) {
    bench.ranges = world.ranges();
    bench.positions = {{6, world.hop_in_body_frame()}};
    const tests::Actions actions = bench.control();
    for (const auto& drive : tests::all<hal::node::exchange::DriveBody>(actions)) {
      command = drive.twist;
    }
    world.move(command);
    if (world.distance_to_hop() < 4.0) return 0.1 * cycle;
  }
  return std::nullopt;
}

class RoundTheWall : public testing::TestWithParam<std::tuple<Passage, Realism>> {};

// For headings all over the sector between two sensors: 60 degrees in steps of 10.
TEST_P(RoundTheWall, PassesCloseWithoutTouching) {
  const auto& [passage, realism] = GetParam();
  for (int degrees = 0; degrees < 60; degrees += 10) {
    World world(passage, realism, degrees * kPi / 180);
    const auto took = drive_to_hop(world);
    ASSERT_TRUE(took.has_value()) << "heading " << degrees << ": stuck before the wall";
    EXPECT_GT(world.clearance(), kBodyRadius + 0.05) << "heading " << degrees;
    EXPECT_LT(world.clearance(), 0.8) << "heading " << degrees;
  }
}

constexpr Passage kPassages[] = {
    {"AcrossTheMiddle", {8, 8}, {25, 25}},      // the case study, hop at (125, 125)
    {"TowardsTheFarRight", {8, 8}, {40, 7}},    // hop at (250, 0): at 45 degrees
    {"TowardsTheFarTop", {8, 8}, {7, 40}},      // hop at (0, 250)
    {"SlightlyLeft", {8, 8}, {24, 26}},         // 4 degrees off the normal
    {"SlightlyRight", {8, 8}, {27, 23}},        // 7 degrees off the normal
    {"FromBehind", {25, 25}, {0, 0}},           // the same wall on the way back
    {"NearTheEnd", {15, 5}, {26, 14}},          // meets the last two metres
    {"AlmostAlong", {5.6, 17.9}, {22.4, 4.2}},  // grazes the wall's whole length
};
constexpr Realism kRealisms[] = {
    {"Ideal", {1e9, 1e9, 1e9, 1e9}, 0},
    {"RealMotors", {}, 0},       // docs/models.md, 1
    {"NoisySensors", {}, 0.02},  // 15 mV at 6 mV per cm near the end of the reach
};
INSTANTIATE_TEST_SUITE_P(CaseStudy, RoundTheWall,
                         testing::Combine(testing::ValuesIn(kPassages),
                                          testing::ValuesIn(kRealisms)),
                         [](const auto& c) {
                           return std::string(std::get<0>(c.param).name) +
                                  std::get<1>(c.param).name;
                         });

// In the wall's frame the robot starts at (-5.94, 0), the wall ends at (0, 10), the hop is at
// (18.10, 0): 5.5 m to the wall, 10 m along it, 20.7 m from its end, less the 4 m at which a hop
// has been reached. No more than 6 s for braking, speeding up and the way past the end.
TEST(RoundTheWall, LosesLittleTimeOverTheShortestWay) {
  World world(kPassages[0], kRealisms[1], 0.2);
  const auto took = drive_to_hop(world);
  ASSERT_TRUE(took.has_value());
  EXPECT_LT(*took, (5.5 + 10 + 20.7 - 4) / 0.94 + 6);
}

// The wall ends 45 m to the left, where the hop's bearing leads, and 5 m to the right. After 30 m
// without an end the robot turns and finds the other one: 30 m there and 35 m back, 14 m besides.
TEST(RoundTheWall, TurnsBackWhenTheEndIsTooFar) {
  const Passage passage{"", {-3, 0}, {10, 3}, {.centre = {0, 20}, .half_x = 0.15, .half_y = 25}};
  World world(passage, kRealisms[1], 0.2);
  const auto took = drive_to_hop(world);
  ASSERT_TRUE(took.has_value());
  EXPECT_GT(*took, 65 / 0.94) << "it did not try the left side";
  EXPECT_LT(*took, (65 + 14) / 0.94 + 15);
  EXPECT_GT(world.clearance(), kBodyRadius + 0.05);
}

// Between two sensors a mote of 5 cm would not be seen; so a sensor has to look ahead.
TEST(RoundAMote, PassesWithoutTouching) {
  const Passage passage{"", {0, 0}, {12, 0}, {.centre = {5, 0}, .half_x = 0.025, .half_y = 0.025}};
  for (int degrees = 0; degrees < 60; degrees += 10) {
    World world(passage, kRealisms[1], degrees * kPi / 180);
    ASSERT_TRUE(drive_to_hop(world).has_value()) << "heading " << degrees;
    EXPECT_GT(world.clearance(), kBodyRadius + 0.05) << "heading " << degrees;
  }
}

}  // namespace
