#include "sim/report/ros_messages.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <span>
#include <stdexcept>

#include "sim/report/cdr.h"
#include "sim/report/ros_schemas.h"

namespace sim::report::test {
namespace {

std::string hexadecimal_of(std::string_view bytes) {
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
TEST(Cdr, AlignsBehindItsHeader) {
  Cdr out;
  out.put(std::uint8_t{1});
  out.put(std::uint16_t{2});
  out.put("ab");
  out.put(true);
  out.put(1.0);
  out.put(std::int32_t{-2});
  EXPECT_EQ(hexadecimal_of(out.bytes()), packed("00010000 01 00 0200 03000000 616200 01"  // at 11
                                                "00000000 000000000000f03f"               // at 16
                                                "feffffff"));
}

TEST(RosMessages, ARangeByHand) {
  const std::string message = range_message({.header = {1'500'000'000, "r"},
                                             .is_infrared = true,
                                             .field_of_view = 0.5,
                                             .low = 1,
                                             .high = 2,
                                             .range = std::numeric_limits<double>::quiet_NaN()});
  EXPECT_EQ(hexadecimal_of(message),
            packed("00010000 01000000 0065cd1d"              // 1 s, 500,000,000 ns
                   "02000000 7200"                           // "r"
                   "01 00"                                   // infrared
                   "0000003f 0000803f 00000040 0000807f"));  // +infinity: REP 117
}

TEST(RosMessages, AFrameByHand) {
  const std::string message = frame_message({.at_ns = 258,
                                             .transmitter = "a",
                                             .receiver = "bc",
                                             .type = "ack",
                                             .sequence = 3,
                                             .retry = true,
                                             .bits = 5,
                                             .airtime_ns = 2'000'000'001});
  EXPECT_EQ(hexadecimal_of(message),
            packed("00010000 00000000 02010000 02000000 6100 0000 03000000 626300 00 04000000 "
                   "61636b00 0300 01 00 05000000 02000000 01000000"  // airtime
                   "00000000"));
}

// A robot at (1, 2) that looks along y; its part, half a metre forward, is drawn at (1, 2.5).
TEST(RosMessages, AMarkerStandsWhereItsBodyTurnedIt) {
  const RosMarker marker{.name = "r0",
                         .solid = {.size = {1, 1, 1}, .centre = {0.5, 0, 0.25}},
                         .pose = {1, 2, 1.5707963267948966}};
  const std::string message = marker_array(std::span(&marker, 1));
  // Encapsulation 4, count 4, header 8 + 4 + 6 + 2, name 4 + 3 + 1, id, type, action; align to 8.
  const std::size_t place = 4 + 48;
  ASSERT_GT(message.size(), place + 24);
  double at[3];
  std::memcpy(at, message.data() + place, sizeof at);
  EXPECT_NEAR(at[0], 1, 1e-15);
  EXPECT_NEAR(at[1], 2.5, 1e-15);
  EXPECT_EQ(at[2], 0.25);
}

TEST(RosSchemas, ADefinitionBringsWhatItNamesOnceEach) {
  const std::string line(80, '=');
  EXPECT_EQ(ros_schema("geometry_msgs/msg/PoseStamped"),
            "std_msgs/Header header\nPose pose\n" + line +
                "\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" + line +
                "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n" + line +
                "\nMSG: geometry_msgs/Pose\nPoint position\nQuaternion orientation\n" + line +
                "\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n" + line +
                "\nMSG: geometry_msgs/Quaternion\nfloat64 x 0\nfloat64 y 0\nfloat64 z 0\n"
                "float64 w 1\n");
  EXPECT_THROW(ros_schema("geometry_msgs/msg/Nothing"), std::out_of_range);
  EXPECT_THROW(ros_schema("Pose"), std::out_of_range);
}

}  // namespace
}  // namespace sim::report::test
