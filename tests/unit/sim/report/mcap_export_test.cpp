#include "sim/report/mcap_export.h"

#include <gtest/gtest.h>

#include <limits>

#include "sim/report/ros_messages.h"
#include "tests/unit/sim/record/test_run.h"

namespace sim::report::test {
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

struct Exported {
  std::string bytes;
  std::uint64_t messages = 0;

  /// Where a message stands; npos: it is not there.
  std::size_t place(std::string_view message) const { return bytes.find(message); }
  bool has(std::string_view message) const { return place(message) != std::string::npos; }
};

Exported write(const std::string& sql) {
  const Folder folder("mcap");
  make_result(folder.path(), kAgents + sql);
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
  const std::size_t places[] = {made.place(controller_state(5, "m0", "FIRST")),
                                made.place(pose_stamped({10, "world"}, {1, 1, 0})),
                                made.place(controller_state(20, "r0", "LATER")),
                                made.place(pose_stamped({30, "world"}, {1, 2, 0}))};
  for (int i = 0; i < 3; ++i) EXPECT_LT(places[i], places[i + 1]) << i;
  EXPECT_NE(places[3], std::string::npos);
  // Poses of the robot 2, transforms and markers of two instants, states 2.
  EXPECT_EQ(made.messages, kAlways + 2 + 2 * 2 + 2);
  const RosTransform both[] = {{{10, "world"}, "m0/base_link", {0, 0, 0}, 0},
                               {{10, "world"}, "r0/base_link", {1, 1, 0}, 0}};
  EXPECT_TRUE(made.has(tf_message(both)));
}

TEST(McapExport, ToldAndDeliveredAreFates) {
  const Exported made = write(
      "INSERT INTO messages VALUES (1, 7, 2, 'help', 9, 100, 'handed over', 150, 'delivered'),"
      " (1, 8, 2, 'help', 9, 100, NULL, NULL, 'expired');"
      "INSERT INTO deliveries VALUES (1, 7, 2, 140, 40, 1);");
  EXPECT_EQ(made.messages, kAlways + 2);
  const std::size_t delivered = made.place(message_fate({140, "m0", 7, "r0", "", "delivered"}));
  const std::size_t told = made.place(message_fate({150, "m0", 7, "m0", "handed over", ""}));
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
  EXPECT_TRUE(made.has(odometry({20, "r0/odom"}, "r0/base_link", {1, 2, 3}, {4, 5, 6})));
  EXPECT_TRUE(made.has(odometry({30, "r0/odom"}, "r0/base_link", {7, 2, 3}, {4, 5, 6})));
}

RosRange range_of(int sensor, std::int64_t at, double metres) {
  return {.header = {at, "r0/infrared_" + std::to_string(sensor)},
          .field_of_view = sensor == 0 ? 0.1 : 0,
          .low = sensor == 0 ? 0.25 : 0.5,
          .high = sensor == 0 ? 1.0 : 2.0,
          .range = metres};
}

constexpr const char* kInfraredObservable =
    "INSERT INTO observables VALUES (1, 'sensors.infrared.1', 2, 'm', 'samples', NULL, 0);"
    "INSERT INTO observable_samples VALUES (1, 10, 0.75);";

TEST(McapExport, RangesComeFromObservablesWithoutReadings) {
  const Exported made = write(kInfraredObservable);
  EXPECT_EQ(made.messages, kAlways + 1);
  EXPECT_TRUE(made.has(range_message(range_of(1, 10, 0.75))));
}

TEST(McapExport, ReadingsWinOverObservables) {
  const Exported made =
      write(std::string(kInfraredObservable) +
            "INSERT INTO readings (agent, at_ns, channel, reading) VALUES"
            " (2, 20, 'infrared', '0.31 -'), (2, 30, 'odometry', '1 2 3 4 5 -6e-1'),"
            " (2, 40, 'front', '- -inf'), (2, 50, 'front', '1'), (2, 60, 'unknown', '1');");
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(made.messages, kAlways + 2 + 1 + 1);
  EXPECT_TRUE(made.has(range_message(range_of(0, 20, 0.31))));
  EXPECT_TRUE(made.has(range_message(range_of(1, 20, nothing))));
  EXPECT_TRUE(made.has(odometry({30, "r0/odom"}, "r0/base_link", {1, 2, 3}, {4, 5, -0.6})));
  EXPECT_TRUE(
      made.has(laser_scan({.header = {40, "r0/front"},
                           .first = -0.5,
                           .last = 0.5,
                           .step = 1,
                           .low = 0.125,
                           .high = 4,
                           .ranges = {nothing, -std::numeric_limits<double>::infinity()}})));
}

TEST(McapExport, AnEntryWithoutHopsIsARouteThatIsGone) {
  const Exported made = write(
      "INSERT INTO routes VALUES (1, 10, 'help', 2, 2, 3, 500, 7.5, 0.25, NULL),"
      " (1, 20, 'help', 2, 2, NULL, NULL, NULL, NULL, NULL);");
  EXPECT_EQ(made.messages, kAlways + 2);
  EXPECT_TRUE(made.has(route_message({.at_ns = 10,
                                      .agent = "m0",
                                      .topic = "help",
                                      .destination = "r0",
                                      .next_hop = "r0",
                                      .hops = 3,
                                      .delay_ns = 500,
                                      .min_snr_db = 7.5,
                                      .energy = 0.25})));
  EXPECT_TRUE(made.has(route_message({.at_ns = 20,
                                      .agent = "m0",
                                      .topic = "help",
                                      .destination = "r0",
                                      .next_hop = "r0",
                                      .removed = true})));
}

}  // namespace
}  // namespace sim::report::test
