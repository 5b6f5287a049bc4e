#include "idl/ros/values.h"

#include <gtest/gtest.h>

#include <cmath>

namespace idl::ros::test {
namespace {

using geometry_msgs::msg::dds_::Quaternion_;

TEST(RosValues, AHeadingSurvivesTheQuaternion) {
  for (const double theta : {0.0, 1e-9, 0.5, -2.0, 3.1, -3.1}) {
    EXPECT_NEAR(heading_of(to_quaternion(theta)), theta, 1e-15) << theta;
  }
}

TEST(RosValues, RollAndPitchDoNotDisturbTheHeading) {
  // First 20 degrees about x, then 30 about y, then 90 about z: the Hamilton product of the three
  // quaternions.
  Quaternion_ q;
  q.x(-0.06162841671621931);
  q.y(0.2988362387301198);
  q.z(0.6408563820557885);
  q.w(0.7044160264027588);
  EXPECT_NEAR(heading_of(q), std::acos(0.0), 1e-15);
}

TEST(RosValues, TimesAreSplitIntoSecondsAndNanoseconds) {
  const auto stamp = to_ros(hal::time_from_ns(3'000'000'007));
  EXPECT_EQ(stamp.sec(), 3);
  EXPECT_EQ(stamp.nanosec(), 7u);
}

}  // namespace
}  // namespace idl::ros::test
