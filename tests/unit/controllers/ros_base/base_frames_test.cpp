#include "controllers/ros_base/base_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "controllers/ros_base/urdf.h"

namespace {

using controllers::WheelLink;

constexpr double kPi = std::numbers::pi;

std::vector<std::string> names_of(const std::vector<hal::BodyWheel>& wheels) {
  std::vector<std::string> names;
  for (const WheelLink& one : controllers::wheel_links({"", {}, wheels})) names.push_back(one.name);
  return names;
}

hal::BodyWheel wheel_at(double x, double y, bool is_driven = true) {
  return {.is_driven = is_driven, .position = {x, y}, .axle_heading = -kPi / 2, .radius = 0.1};
}

/// v turned by a unit quaternion.
hal::Vec3 turned(const geometry_msgs::msg::dds_::Quaternion_& q, const hal::Vec3& v) {
  const auto cross = [](const hal::Vec3& a, const hal::Vec3& b) {
    return hal::Vec3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  const hal::Vec3 u{q.x(), q.y(), q.z()};
  return v + 2 * cross(u, cross(u, v) + q.w() * v);
}

TEST(WheelLinks, OfTwoDrivenWheelsAreLeftAndRight) {
  EXPECT_EQ(names_of({wheel_at(0, -0.1), wheel_at(0, 0.1), wheel_at(-0.1, 0, false)}),
            (std::vector<std::string>{"wheel_right", "wheel_left", "caster_0"}));
}

TEST(WheelLinks, OfOtherDrivesAreNumbered) {
  EXPECT_EQ(
      names_of({wheel_at(0.1, 0.1), wheel_at(0, 0, false), wheel_at(0.1, -0.1), wheel_at(-0.1, 0)}),
      (std::vector<std::string>{"wheel_0", "caster_0", "wheel_1", "wheel_2"}));
  EXPECT_EQ(names_of({wheel_at(0, 0.1), wheel_at(0, 0.2)}),
            (std::vector<std::string>{"wheel_0", "wheel_1"}));
}

TEST(WheelRotation, RollsThePointOnTopForwards) {
  const WheelLink wheel{"w", wheel_at(0, 0.1)};  // a positive speed drives along x
  const hal::Vec3 top = turned(controllers::wheel_rotation(wheel, 0.5), {0, 0, 1});
  EXPECT_NEAR(top.x, std::sin(0.5), 1e-12);
  EXPECT_NEAR(top.y, 0, 1e-12);
  EXPECT_NEAR(top.z, std::cos(0.5), 1e-12);
}

TEST(WheelRotation, KeepsTheAxle) {
  WheelLink wheel{"w", wheel_at(0, 0.1)};
  for (const double heading : {0.0, 1.0, -2.0}) {
    wheel.wheel.axle_heading = heading;
    for (const double angle : {0.0, 1.0, 4.0}) {
      const hal::Vec3 axle = turned(controllers::wheel_rotation(wheel, angle), {0, 1, 0});
      EXPECT_NEAR(axle.x, -std::cos(heading), 1e-12);
      EXPECT_NEAR(axle.y, -std::sin(heading), 1e-12);
      EXPECT_NEAR(axle.z, 0, 1e-12);
    }
  }
}

TEST(FixedLinks, AreThoseOfSensorsWithAPlaceAndOfCasters) {
  hal::Channel scan, bumper;
  scan.name = "scan", scan.position = {0.1, 0.2, 0.3}, scan.heading = 0.4;
  bumper.name = "bumper";
  const std::vector<hal::Channel> channels{bumper, scan};
  const auto links = controllers::fixed_links(channels, {"", {}, {wheel_at(-0.1, 0, false)}});
  ASSERT_EQ(links.size(), 2);
  EXPECT_EQ(links[0].link, "base_scan");
  EXPECT_EQ(links[0].at, scan.position);
  EXPECT_EQ(links[0].yaw, 0.4);
  EXPECT_EQ(links[1].link, "caster_0_link");
  EXPECT_EQ(links[1].at, (hal::Vec3{-0.1, 0, 0.1}));
}

TEST(Urdf, NamesAreEscaped) {
  const std::string urdf = controllers::urdf_of({"a<b & \"c\"", {}, {}}, {}, "base_link");
  EXPECT_NE(urdf.find("<robot name=\"a&lt;b &amp; &quot;c&quot;\">"), std::string::npos) << urdf;
  EXPECT_EQ(urdf.find("base_joint"), std::string::npos) << "base_link is the root";
}

TEST(Urdf, HasTheShapesThatTheFileHas) {
  const hal::RobotBody body{"r",
                            {{hal::Solid::Shape::kCylinder, {0.2, 0.2, 0.5}, {0, 0, 0.25}, 0},
                             {hal::Solid::Shape::kBox, {1, 2, 3}, {0.1, 0, 0}, 0.5}},
                            {wheel_at(-0.1, 0, false)}};
  const std::string urdf = controllers::urdf_of(body, {}, "base_footprint");
  for (const char* part : {"<cylinder radius=\"0.1\" length=\"0.5\"/>", "<box size=\"1 2 3\"/>",
                           "<origin xyz=\"0.1 0 0\" rpy=\"0 0 0.5\"/>", "<sphere radius=\"0.1\"/>",
                           "<parent link=\"base_footprint\"/><child link=\"base_link\"/>"}) {
    EXPECT_NE(urdf.find(part), std::string::npos) << part << " is not in\n" << urdf;
  }
  EXPECT_EQ(urdf.find("inertial"), std::string::npos);
}

}  // namespace
