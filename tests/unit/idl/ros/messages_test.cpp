#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "idl/ros/cdr.h"
#include "idl/ros/markers.h"
#include "idl/ros/schemas.h"
#include "idl/ros/sensors.h"
#include "idl/ros/values.h"
#include "inspectPubSubTypes.h"

namespace idl::ros::test {
namespace {

template <class Message>
std::string hexadecimal_of(const Message& message) {
  std::string bytes = "what was there before, longer than most messages that a test writes";
  write_cdr(message, bytes);
  std::string text;
  for (const char byte : bytes) text += fmt::format("{:02x}", static_cast<std::uint8_t>(byte));
  return text;
}

std::string packed(std::string text) {
  std::erase(text, ' ');
  return text;
}

// OMG DDS-XTypes 1.3, 7.4.1: numbers stand at multiples of their size, counted behind the four
// bytes of the encapsulation; texts have a zero byte that counts.
TEST(RosMessages, ASonarsReadingByHand) {
  hal::Channel channel;
  channel.frame = "s";
  channel.headings = {-0.25, 0.25};
  channel.low = 1;
  channel.high = 2;
  sensor_msgs::msg::dds_::Range_ message;
  Sonar::describe(message, "r", channel);
  const double nothing[] = {std::numeric_limits<double>::quiet_NaN()};
  Sonar::measure(message, hal::time_from_ns(1'500'000'000), nothing);
  EXPECT_EQ(hexadecimal_of(message),
            packed("00010000 01000000 0065cd1d"              // 1 s, 500,000,000 ns
                   "04000000 722f7300"                       // "r/s"
                   "00 000000"                               // ultrasound
                   "0000003f 0000803f 00000040 0000807f"));  // +infinity: REP 117
}

TEST(RosMessages, AFrameByHand) {
  baraka_msgs::msg::dds_::Frame_ frame;
  frame.stamp(to_ros(hal::time_from_ns(258)));
  frame.transmitter("a");
  frame.receiver("bc");
  frame.frame_type("ack");
  frame.sequence_number(3);
  frame.retry(true);
  frame.bits(5);
  frame.airtime(to_ros(hal::Duration(2'000'000'001)));
  frame.rate(6.5e6);
  frame.modulation("HE");
  frame.mcs(-1);
  frame.streams(2);
  frame.width(80);
  frame.guard_interval(800);
  frame.access_category("VI");
  frame.ampdu(9);
  EXPECT_EQ(hexadecimal_of(frame),
            packed("00010000 00000000 02010000 02000000 6100 0000 03000000 626300 00 04000000 "
                   "61636b00 0300 01 00 05000000 02000000 01000000"  // airtime
                   "00000000 00000000 00000000a8cb5841"              // skipped, rate
                   "03000000 484500 00 ffff 0200 5000 2003"          // HE, no MCS, 800 ns
                   "03000000 564900 00 09000000"));
}

// A robot at (1, 2) that looks along y; its part, half a metre forward, is drawn at (1, 2.5).
TEST(RosMessages, AMarkerStandsWhereItsBodyTurnedIt) {
  const hal::DrawnBody body{.name = "r0",
                            .kind = hal::DrawnAs::kRobot,
                            .solids = {{.size = {1, 1, 1}, .centre = {0.5, 0, 0.25}}}};
  std::vector<visualization_msgs::msg::dds_::Marker_> markers;
  add_markers(markers, hal::Time{}, "part", {body, {1, 2, std::acos(0.0)}});
  ASSERT_EQ(markers.size(), 1u);
  EXPECT_EQ(markers[0].ns(), "part");
  EXPECT_NEAR(markers[0].pose().position().x(), 1, 1e-15);
  EXPECT_NEAR(markers[0].pose().position().y(), 2.5, 1e-15);
  EXPECT_EQ(markers[0].pose().position().z(), 0.25);
}

/// "sensor_msgs::msg::dds_::Range_" as "sensor_msgs/msg/Range".
std::string without_dds(std::string name) {
  name.pop_back();
  name.replace(name.find("::dds_::"), 8, "/");
  name.replace(name.find("::"), 2, "/");
  return name;
}

template <class... PubSub>
std::vector<std::pair<std::string, std::string_view>> names() {
  return {{without_dds(PubSub().getName()), kTypeName<typename PubSub::type>}...};
}

TEST(RosMessages, TypesHaveTheirNamesOfDdsAndASchema) {
  for (const auto& [generated, written] :
       names<std_msgs::msg::dds_::Bool_PubSubType, geometry_msgs::msg::dds_::PoseStamped_PubSubType,
             tf2_msgs::msg::dds_::TFMessage_PubSubType, nav_msgs::msg::dds_::Odometry_PubSubType,
             sensor_msgs::msg::dds_::Range_PubSubType, sensor_msgs::msg::dds_::Imu_PubSubType,
             sensor_msgs::msg::dds_::BatteryState_PubSubType,
             sensor_msgs::msg::dds_::LaserScan_PubSubType,
             visualization_msgs::msg::dds_::MarkerArray_PubSubType,
             baraka_msgs::msg::dds_::Frame_PubSubType,
             baraka_msgs::msg::dds_::MessageFate_PubSubType,
             baraka_msgs::msg::dds_::Route_PubSubType,
             baraka_msgs::msg::dds_::ControllerState_PubSubType,
             baraka_msgs::msg::dds_::Value_PubSubType>()) {
    EXPECT_EQ(written, generated);
    EXPECT_FALSE(schema(written).empty()) << written;
  }
}

TEST(RosMessages, AKindWithoutAMessageIsPassedOver) {
  int calls = 0;
  for (const char* kind : {"scan", "battery", "infrared", ""}) {
    for_kind(kind, [&calls](auto) { ++calls; });
  }
  EXPECT_EQ(calls, 2);
}

TEST(RosSchemas, ADefinitionBringsWhatItNamesOnceEach) {
  const std::string line(80, '=');
  EXPECT_EQ(schema("geometry_msgs/msg/PoseStamped"),
            "std_msgs/Header header\nPose pose\n" + line +
                "\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" + line +
                "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n" + line +
                "\nMSG: geometry_msgs/Pose\nPoint position\nQuaternion orientation\n" + line +
                "\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n" + line +
                "\nMSG: geometry_msgs/Quaternion\nfloat64 x 0\nfloat64 y 0\nfloat64 z 0\n"
                "float64 w 1\n");
  EXPECT_THROW(schema("geometry_msgs/msg/Nothing"), std::out_of_range);
  EXPECT_THROW(schema("Pose"), std::out_of_range);
}

}  // namespace
}  // namespace idl::ros::test
