#pragma once

#include "tests/unit/programs/models/loaded.h"

namespace programs::models::test {

using hal::node::devices::BodyBox;
using hal::node::devices::BodyCylinder;
using hal::node::devices::WheelType;

inline constexpr double kQuarter = 1.5707963267948966;  // rad
inline constexpr double kMesh = 1e-8;                   // m: corners of meshes are single precision

inline void expect_near(const hal::Vec3& a, const hal::Vec3& b, double close = 1e-12) {
  EXPECT_NEAR(a.x, b.x, close);
  EXPECT_NEAR(a.y, b.y, close);
  EXPECT_NEAR(a.z, b.z, close);
}

inline void expect_box(const BodyBox& box, const hal::Vec3& size, const hal::Vec3& centre,
                       double yaw, double close = 1e-12) {
  expect_near(box.size, size, close);
  expect_near(box.centre, centre, close);
  EXPECT_NEAR(box.yaw, yaw, 1e-7);
}

inline void expect_cylinder(const BodyCylinder& one, double radius, double bottom, double top,
                            double close = 1e-12) {
  EXPECT_NEAR(one.radius, radius, close);
  EXPECT_NEAR(one.z_bottom, bottom, close);
  EXPECT_NEAR(one.z_top, top, close);
}

/// The warnings without their file: "18:1: warning: is left out: …".
inline std::vector<std::string> left_out(const std::vector<std::string>& warnings) {
  std::vector<std::string> texts;
  for (const std::string& one : warnings) {
    const std::size_t colon = one.find(':');
    texts.push_back(one.substr(colon + 1, one.find(" (included by") - colon - 1));
  }
  return texts;
}

}  // namespace programs::models::test
