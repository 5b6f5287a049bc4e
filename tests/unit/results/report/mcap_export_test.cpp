#include "results/report/mcap_export.h"

#include <gtest/gtest.h>

#include <limits>

#include "idl/ros/cdr.h"
#include "idl/ros/markers.h"
#include "idl/ros/sensors.h"
#include "idl/ros/values.h"
#include "tests/unit/results/record/test_run.h"

namespace results::report::test {
namespace {

using record::test::Folder;
using record::test::make_result;

constexpr const char* kAgents =
    "INSERT INTO agents VALUES (1, 'm0', 'mote', 'p', 0, 0, 0), (2, 'r0', 'robot', 'p', 1, 2, 0);";

ExportedScene scene() {
  ExportedScene made;
  ExportedAgent& robot = made.agents[2];
  robot.drives = true;
  robot.ranges = {{.field_of_view = 0.1, .low = 0.25, .high = 1}, {.low = 0.5, .high = 2}};
  hal::Channel& scan = robot.channels.emplace_back();
  scan.name = scan.frame = "front";
  scan.kind = "scan";
  scan.length = 2;
  scan.headings = {-0.5, 0.5};
  scan.low = 0.125;
  scan.high = 4;
  return made;
}

using idl::ros::to_ros;

template <class Message>
std::string bytes_of(const Message& message) {
  std::string bytes;
  idl::ros::write_cdr(message, bytes);
  return bytes;
}

std::string controller_state(std::int64_t at, const char* agent, const char* name) {
  baraka_msgs::msg::dds_::ControllerState_ state;
  state.stamp(to_ros(hal::time_from_ns(at)));
  state.agent(agent);
  state.state(name);
  return bytes_of(state);
}

std::string pose_stamped(std::int64_t at, const hal::Pose2& pose) {
  geometry_msgs::msg::dds_::PoseStamped_ message;
  message.header().stamp(to_ros(hal::time_from_ns(at)));
  message.header().frame_id("world");
  message.pose(to_ros(pose));
  return bytes_of(message);
}

std::string message_fate(std::int64_t at, const char* node, const char* fate, const char* verdict) {
  baraka_msgs::msg::dds_::MessageFate_ message;
  message.stamp(to_ros(hal::time_from_ns(at)));
  message.sender("m0");
  message.id(7);
  message.node(node);
  message.fate(fate);
  message.verdict(verdict);
  return bytes_of(message);
}

std::string odometry(std::int64_t at, const hal::Pose2& pose, const hal::Twist2& twist) {
  nav_msgs::msg::dds_::Odometry_ message;
  message.header().stamp(to_ros(hal::time_from_ns(at)));
  message.header().frame_id("r0/odom");
  message.child_frame_id("r0/base_link");
  message.pose().pose(to_ros(pose));
  message.twist().twist(to_ros(twist));
  return bytes_of(message);
}

struct Exported {
  std::string bytes;
  std::uint64_t messages = 0;

  /// Where a message stands; npos: it is not there.
  std::size_t place(std::string_view message) const { return bytes.find(message); }
  bool has(std::string_view message) const { return place(message) != std::string::npos; }
};

Exported write(const std::string& sql) {
  const Folder folder("mcap");
  record::test::make_result(folder.path(), kAgents + sql);
  Exported made;
  made.messages =
      write_mcap(folder.path(), scene(), [&made](std::string_view part) { made.bytes += part; });
  return made;
}

constexpr std::uint64_t kAlways = 2;  // /tf_static and the walls

TEST(McapExport, MergesTablesByTime) {
  const Exported made = write(
      "INSERT INTO poses VALUES (2, 30, 1, 2, 0), (2, 10, 1, 1, 0), (1, 10, 0, 0, 0);"
      "INSERT INTO states VALUES (2, 20, 'LATER'), (1, 5, 'FIRST');");
  const std::size_t places[] = {
      made.place(controller_state(5, "m0", "FIRST")), made.place(pose_stamped(10, {1, 1, 0})),
      made.place(controller_state(20, "r0", "LATER")), made.place(pose_stamped(30, {1, 2, 0}))};
  for (int i = 0; i < 3; ++i) EXPECT_LT(places[i], places[i + 1]) << i;
  EXPECT_NE(places[3], std::string::npos);
  // Poses of the robot 2, transforms and markers of two instants, states 2.
  EXPECT_EQ(made.messages, kAlways + 2 + 2 * 2 + 2);
  tf2_msgs::msg::dds_::TFMessage_ both;
  both.transforms() = {idl::ros::transform_between("world", "m0/base_link", {0, 0, 0}, 0),
                       idl::ros::transform_between("world", "r0/base_link", {1, 1, 0}, 0)};
  for (auto& one : both.transforms()) one.header().stamp(to_ros(hal::time_from_ns(10)));
  EXPECT_TRUE(made.has(bytes_of(both)));
}

TEST(McapExport, MovablesAreTransformsAndMarkersAsTheyLie) {
  const Exported made = write(
      "INSERT INTO movables VALUES (0, 'drum', 'cylinder', 0.5, 0.5, 2, 1);"
      "INSERT INTO movable_poses VALUES (0, 10, 1, 2, 0.25, 0, 1, 0, 0);");
  EXPECT_EQ(made.messages, kAlways + 2);
  geometry_msgs::msg::dds_::Quaternion_ over;  // it lies upside down
  over.x(1);
  tf2_msgs::msg::dds_::TFMessage_ moved;
  moved.transforms() = {idl::ros::transform_between("world", "movables/drum", {1, 2, 0.25}, 0)};
  moved.transforms()[0].header().stamp(to_ros(hal::time_from_ns(10)));
  moved.transforms()[0].transform().rotation(over);
  EXPECT_TRUE(made.has(bytes_of(moved)));
  visualization_msgs::msg::dds_::MarkerArray_ markers;
  hal::Solid solid;
  solid.shape = hal::Solid::Shape::kCylinder;
  solid.size = {0.5, 0.5, 2};
  solid.centre = {1, 2, 0.25};
  const hal::DrawnBody drum{"drum", hal::DrawnAs::kWall, {solid}};
  idl::ros::add_markers(markers.markers(), hal::time_from_ns(10), "movables/drum", {drum, {}});
  markers.markers()[0].pose().orientation(over);
  EXPECT_TRUE(made.has(bytes_of(markers)));
}

TEST(McapExport, ToldAndDeliveredAreFates) {
  const Exported made = write(
      "INSERT INTO messages VALUES (1, 7, 2, 'help', 9, 100, 'handed over', 150, 'delivered', 0),"
      " (1, 8, 2, 'help', 9, 100, NULL, NULL, 'expired', 0);"
      "INSERT INTO deliveries VALUES (1, 7, 2, 140, 40, 1);");
  EXPECT_EQ(made.messages, kAlways + 2);
  const std::size_t delivered = made.place(message_fate(140, "r0", "", "delivered"));
  const std::size_t told = made.place(message_fate(150, "m0", "handed over", ""));
  EXPECT_LT(delivered, told);
  EXPECT_NE(told, std::string::npos);
}

// Each value is held until the next; the first message comes when all six are there.
TEST(McapExport, OdometryIsPutTogetherFromObservables) {
  std::string sql;
  int number = 0;
  for (const char* name : {"x", "y", "yaw", "vx", "vy", "omega"}) {
    sql += "INSERT INTO observables VALUES (" + std::to_string(++number) + ", 'sensors.odometry." +
           name + "', 2, 'm', 'samples', NULL, 0);";
    sql += "INSERT INTO observable_samples VALUES (" + std::to_string(number) + ", " +
           (number == 6 ? "20" : "10") + ", " + std::to_string(number) + ");";
  }
  sql += "INSERT INTO observable_samples VALUES (1, 30, 7);";
  const Exported made = write(sql);
  EXPECT_EQ(made.messages, kAlways + 2);
  EXPECT_TRUE(made.has(odometry(20, {1, 2, 3}, {4, 5, 6})));
  EXPECT_TRUE(made.has(odometry(30, {7, 2, 3}, {4, 5, 6})));
}

std::string range_of(int sensor, std::int64_t at, double metres) {
  sensor_msgs::msg::dds_::Range_ message;
  message.header().stamp(to_ros(hal::time_from_ns(at)));
  message.header().frame_id("r0/infrared_" + std::to_string(sensor));
  message.radiation_type(1);
  message.field_of_view(sensor == 0 ? 0.1F : 0);
  message.min_range(sensor == 0 ? 0.25F : 0.5F);
  message.max_range(sensor == 0 ? 1.0F : 2.0F);
  message.range(idl::ros::to_ros_distance(metres));
  return bytes_of(message);
}

constexpr const char* kInfraredObservable =
    "INSERT INTO observables VALUES (1, 'sensors.infrared.1', 2, 'm', 'samples', NULL, 0);"
    "INSERT INTO observable_samples VALUES (1, 10, 0.75);";

TEST(McapExport, RangesComeFromObservablesWithoutReadings) {
  const Exported made = write(kInfraredObservable);
  EXPECT_EQ(made.messages, kAlways + 1);
  EXPECT_TRUE(made.has(range_of(1, 10, 0.75)));
}

TEST(McapExport, ReadingsWinOverObservables) {
  const Exported made =
      write(std::string(kInfraredObservable) +
            "INSERT INTO readings (agent, at_ns, channel, reading) VALUES"
            " (2, 20, 'infrared', '0.31 -'), (2, 30, 'odometry', '1 2 3 4 5 -6e-1'),"
            " (2, 40, 'front', '- -inf'), (2, 50, 'front', '1'), (2, 60, 'unknown', '1');");
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(made.messages, kAlways + 2 + 1 + 1);
  EXPECT_TRUE(made.has(range_of(0, 20, 0.31)));
  EXPECT_TRUE(made.has(range_of(1, 20, nothing)));
  EXPECT_TRUE(made.has(odometry(30, {1, 2, 3}, {4, 5, -0.6})));
  sensor_msgs::msg::dds_::LaserScan_ scan;
  idl::ros::Scan::describe(scan, "r0", scene().agents.at(2).channels.front());
  const double values[] = {nothing, -std::numeric_limits<double>::infinity()};
  idl::ros::Scan::measure(scan, hal::time_from_ns(40), values);
  EXPECT_TRUE(made.has(bytes_of(scan)));
}

TEST(McapExport, AnEntryWithoutHopsIsARouteThatIsGone) {
  const Exported made = write(
      "INSERT INTO routes VALUES (1, 10, 'help', 2, 2, 3, 500, 7.5, 0.25, NULL),"
      " (1, 20, 'help', 2, 2, NULL, NULL, NULL, NULL, NULL);");
  EXPECT_EQ(made.messages, kAlways + 2);
  baraka_msgs::msg::dds_::Route_ route;
  route.stamp(to_ros(hal::time_from_ns(10)));
  route.agent("m0");
  route.message_class("help");
  route.destination("r0");
  route.next_hop("r0");
  route.hops(3);
  route.delay(to_ros(hal::Duration(500)));
  route.min_snr_db(7.5);
  route.energy(0.25);
  EXPECT_TRUE(made.has(bytes_of(route)));
  baraka_msgs::msg::dds_::Route_ gone;
  gone.stamp(to_ros(hal::time_from_ns(20)));
  gone.agent("m0");
  gone.message_class("help");
  gone.destination("r0");
  gone.next_hop("r0");
  gone.removed(true);
  EXPECT_TRUE(made.has(bytes_of(gone)));
}

}  // namespace
}  // namespace results::report::test
