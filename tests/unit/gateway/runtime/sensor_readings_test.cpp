#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/gateway/runtime/one_agent.h"

/// What a controller reads of the sensors of a robot's file, and what it drives on fixed wheels.
namespace gateway::runtime {
namespace {

using hal::node::exchange::ControlDue;

/// Keeps what each call gave in the last control cycle.
struct Looker : hal::Controller {
  Looker(hal::Robot& the_robot, const hal::Parameters&) : robot(the_robot) {}
  void step() override {
    const auto said = [](const auto& result) {
      return result ? std::string("given") : result.error().message;
    };
    robot.log(hal::log::Level::kInfo, "scan " + said(robot.scan()));
    robot.log(hal::log::Level::kInfo, "pose " + said(robot.pose()));
    robot.log(hal::log::Level::kInfo, "imu " + said(robot.imu()));
    robot.log(hal::log::Level::kInfo, "bumper " + said(robot.bumped()));
    if (const auto scan = robot.scan()) {
      EXPECT_EQ(std::vector(scan->headings.begin(), scan->headings.end()),
                (std::vector{-0.5, 0.0, 0.5}));
      EXPECT_EQ(scan->ranges[2], 3);
    }
    if (const auto pose = robot.pose()) {
      EXPECT_EQ(*pose, (hal::Pose2{1, 2, 0.5}));
    }
    if (const auto imu = robot.imu()) {
      EXPECT_EQ(imu->angular_velocity, (hal::Vec3{1, 2, 3}));
      EXPECT_EQ(imu->specific_force, (hal::Vec3{4, 5, 6}));
    }
    if (const auto bumped = robot.bumped()) {
      EXPECT_TRUE(*bumped);
    }
    const auto drive = robot.set_body_velocity({0.1, 0.2, 0.5});
    ASSERT_TRUE(drive);
    robot.log(hal::log::Level::kInfo, drive->restricted ? "restricted" : "free");
  }
  hal::Robot& robot;
};

hal::ControllerKind kind() {
  hal::ControllerKind kind;
  kind.name = "looker";
  kind.wants.optional = {"scan", "pose", "imu", "bumper"};
  kind.make_for_robot = hal::make_for_robot<Looker>;
  return kind;
}

/// Two fixed wheels 0.16 m apart, of 0.033 m, and the four sensors; channels 16 .. 19.
hal::node::exchange::AgentSession session() {
  hal::node::exchange::AgentSession session = tests::robot_session();
  session.channels.clear();
  const auto add = [&](const char* name, std::uint32_t length) -> hal::Channel& {
    hal::Channel channel;
    channel.id = static_cast<std::uint16_t>(16 + session.channels.size());
    channel.name = channel.kind = name;
    channel.length = length;
    return session.channels.emplace_back(channel);
  };
  add("scan", 3).headings = {-0.5, 0, 0.5};
  add("pose", 3);
  add("imu", 6);
  add("bumper", 1);
  constexpr double kR = 0.033, kB = 0.08;
  session.limits.body_to_wheel = {{1 / kR, 0, -kB / kR}, {1 / kR, 0, kB / kR}};
  session.limits.wheel_to_body = {{kR / 2, 0, -kR / (2 * kB)}, {kR / 2, 0, kR / (2 * kB)}};
  session.limits.wheel_speed = 6.67;
  return session;
}

std::vector<std::string> log_of(const tests::Actions& actions) {
  return tests::texts<hal::node::exchange::Log>(actions);
}

TEST(SensorReadings, ReachTheControllerByTheirTypedCalls) {
  tests::OneAgent agent(kind(), session());
  agent.start();
  auto control = agent.event(ControlDue{});
  control.readings = {{16, {1, 2, 3}}, {17, {1, 2, 0.5}}, {18, {1, 2, 3, 4, 5, 6}}, {19, {1}}};
  const auto lines = log_of(agent.feed(control));
  EXPECT_EQ(lines, (std::vector<std::string>{"scan given", "pose given", "imu given",
                                             "bumper given", "restricted"}));
}

TEST(SensorReadings, ThatAreNotThereAreSaidToBe) {
  tests::OneAgent agent(kind(), session());
  agent.start();
  const auto before = log_of(agent.control());
  EXPECT_EQ(before[0], "scan channel 'scan' has not been sampled yet");
  tests::OneAgent blind(kind(), tests::robot_session());
  blind.start();
  const auto lines = log_of(blind.control());
  EXPECT_EQ(lines[0], "scan no channel 'scan': the agent has none or it was not asked for");
  EXPECT_EQ(lines[4], "free") << "an omnidirectional robot drives anywhere";
}

TEST(FixedWheels, LeaveOutWhatTheyCannotDo) {
  tests::OneAgent agent(kind(), session());
  agent.start();
  const auto actions = agent.control();
  const auto drives = tests::all<hal::node::exchange::DriveBody>(actions);
  ASSERT_FALSE(drives.empty()) << "it did not drive";
  EXPECT_NEAR(drives[0].twist.vx, 0.1, 1e-12);
  EXPECT_NEAR(drives[0].twist.vy, 0, 1e-12);
  EXPECT_NEAR(drives[0].twist.omega, 0.5, 1e-12);
}

}  // namespace
}  // namespace gateway::runtime
