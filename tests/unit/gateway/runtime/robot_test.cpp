#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/gateway/runtime/one_agent.h"
#include "tests/unit/gateway/runtime/scripted.h"

namespace {

using hal::Errc;
using hal::node::exchange::DriveBody;
using hal::node::exchange::DriveWheels;
using hal::node::exchange::Log;
using tests::Actions;
using tests::Scripted;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Lets a robot do one thing in its first step and gives the actions that leave it.
Actions actions_of_robot(std::function<void(hal::Robot&)> step) {
  Scripted::next() = {.step = std::move(step)};
  tests::OneAgent agent(Scripted::kind(), tests::robot_session());
  return agent.control();
}

TEST(SetBodyVelocity, LeavesACommandWithinTheLimitsAsItIs) {
  const hal::Twist2 twist{.vx = 0.5, .vy = -0.2, .omega = 0.3};
  const Actions actions = actions_of_robot([&](hal::Robot& robot) {
    const auto drive = robot.set_body_velocity(twist);
    ASSERT_TRUE(drive.has_value());
    EXPECT_EQ(drive->applied, twist);
    EXPECT_FALSE(drive->saturated);
  });
  ASSERT_EQ(actions.size(), 1U);
  EXPECT_EQ(std::get<DriveBody>(actions[0].what).twist, twist);
}

TEST(Body, IsThatOfTheSession) {
  auto session = tests::robot_session();
  session.body = {
      "robertino", {{.size = {1, 2, 3}, .centre = {}}}, {{.position = {0.1, 0}, .radius = 0.04}}};
  const hal::RobotBody expected = session.body;
  Scripted::next() = {.step = [&](hal::Robot& robot) { EXPECT_EQ(robot.body(), expected); }};
  tests::OneAgent agent(Scripted::kind(), session);
  EXPECT_TRUE(agent.control().empty());
}

// Along y the wheel at 180 degrees runs at vy / r: the limit is 23.56 * 0.04 = 0.9424 m/s. Asked
// for twice that, with a rotation that takes part: all three are scaled by one factor f, for which
// f * (2 * 0.9424 / 0.04 + 0.132 * 1 / 0.04) = 23.56.
TEST(SetBodyVelocity, ScalesAllThreeByOneFactorSoThatTheFastestWheelIsAtItsLimit) {
  const hal::Twist2 twist{.vx = 0.1, .vy = -2 * 0.9424, .omega = 1.0};
  const double factor = 23.56 / (2 * 0.9424 / 0.04 + 0.132 / 0.04);
  const Actions actions = actions_of_robot([&](hal::Robot& robot) {
    const auto drive = robot.set_body_velocity(twist);
    ASSERT_TRUE(drive.has_value());
    EXPECT_TRUE(drive->saturated);
    const double rounding = 1e-12;
    EXPECT_NEAR(drive->applied.vx, factor * twist.vx, rounding);
    EXPECT_NEAR(drive->applied.vy, factor * twist.vy, rounding);
    EXPECT_NEAR(drive->applied.omega, factor * twist.omega, rounding);
  });
  ASSERT_EQ(actions.size(), 1U);
  EXPECT_NEAR(std::get<DriveBody>(actions[0].what).twist.vy, factor * twist.vy, 1e-12);
}

TEST(SetBodyVelocity, RefusesWhatIsNotFiniteAndLogsAgentFieldAndValue) {
  const Actions actions = actions_of_robot([](hal::Robot& robot) {
    const auto nan = robot.set_body_velocity({.vx = 0, .vy = kNan, .omega = 0});
    ASSERT_FALSE(nan.has_value());
    EXPECT_EQ(nan.error().code, Errc::kInvalidArgument);
    EXPECT_FALSE(robot.set_body_velocity({.omega = INFINITY}).has_value());
  });
  ASSERT_EQ(actions.size(), 2U) << "the refused commands themselves do not leave";
  EXPECT_EQ(
      std::get<Log>(actions[0].what),
      (Log{hal::log::Level::kWarning, "r0: set_body_velocity: vy is nan, it must be finite"}));
  EXPECT_EQ(tests::text_of(actions[1]), "r0: set_body_velocity: omega is inf, it must be finite");
}

TEST(SetBodyVelocity, IsNotAvailableWithoutWheels) {
  auto session = tests::robot_session();
  session.limits = {};
  Scripted::next() = {.step = [](hal::Robot& robot) {
    const auto drive = robot.set_body_velocity({.vx = 0.1});
    ASSERT_FALSE(drive.has_value());
    EXPECT_EQ(drive.error().code, Errc::kNotAvailable);
  }};
  tests::OneAgent agent(Scripted::kind(), session);
  EXPECT_TRUE(agent.control().empty());
}

TEST(SetWheelSpeeds, PassesSpeedsUpToTheLimit) {
  const std::vector<double> speeds{23.56, -23.56, 0};
  const Actions actions = actions_of_robot(
      [&](hal::Robot& robot) { EXPECT_TRUE(robot.set_wheel_speeds(speeds).has_value()); });
  ASSERT_EQ(actions.size(), 1U);
  EXPECT_EQ(std::get<DriveWheels>(actions[0].what).speeds, speeds);
}

TEST(SetWheelSpeeds, RefusesTooManyTooFastAndNanNamingTheWheel) {
  const Actions actions = actions_of_robot([](hal::Robot& robot) {
    EXPECT_FALSE(robot.set_wheel_speeds(std::vector<double>{1, 1}).has_value());
    EXPECT_FALSE(robot.set_wheel_speeds(std::vector<double>{1, -23.6, 1}).has_value());
    EXPECT_FALSE(robot.set_wheel_speeds(std::vector<double>{1, 1, kNan}).has_value());
  });
  ASSERT_EQ(actions.size(), 3U);
  EXPECT_EQ(tests::text_of(actions[0]),
            "r0: set_wheel_speeds: speeds has 2 values, the robot has 3 wheels");
  EXPECT_EQ(tests::text_of(actions[1]),
            "r0: set_wheel_speeds: speeds[1] is -23.6 rad/s, the limit is 23.56 rad/s");
  EXPECT_EQ(tests::text_of(actions[2]),
            "r0: set_wheel_speeds: speeds[2] is nan rad/s, the limit is 23.56 rad/s");
}

/// Feeds a robot one control event with readings and hands it to `step`.
void with_readings(std::vector<hal::node::exchange::Reading> readings,
                   std::function<void(hal::Robot&)> step) {
  Scripted::next() = {.step = std::move(step)};
  tests::OneAgent agent(Scripted::kind(), tests::robot_session());
  auto event = agent.event(hal::node::exchange::ControlDue{});
  event.readings = std::move(readings);
  EXPECT_TRUE(agent.feed(event).empty());
}

TEST(Infrared, GivesRangesWithTheirHeadings) {
  with_readings({{.channel = 0, .values = {0.3, kNan, 0.5, 0.6, 0.7, 0.8}}}, [](hal::Robot& robot) {
    const auto infrared = robot.infrared();
    ASSERT_TRUE(infrared.has_value());
    ASSERT_EQ(infrared->size(), 6U);
    EXPECT_EQ((*infrared)[0].range, 0.3);
    EXPECT_TRUE(std::isnan((*infrared)[1].range));
    EXPECT_NEAR((*infrared)[5].heading, -1.0471975511965976, 1e-15);
  });
}

TEST(Odometry, ReadsPoseThenTwist) {
  with_readings({{.channel = 2, .values = {1, 2, 3, 4, 5, 6}}}, [](hal::Robot& robot) {
    const auto odometry = robot.odometry();
    ASSERT_TRUE(odometry.has_value());
    EXPECT_EQ(odometry->pose, (hal::Pose2{1, 2, 3}));
    EXPECT_EQ(odometry->twist, (hal::Twist2{4, 5, 6}));
  });
}

TEST(RelativePosition, FindsTheAgentsTriple) {
  with_readings({{.channel = 1, .values = {3, 10, 11, 7, 20, 21}}}, [](hal::Robot& robot) {
    const auto position = robot.relative_position(hal::AgentId{7});
    ASSERT_TRUE(position.has_value());
    EXPECT_EQ(*position, (hal::Vec2{20, 21}));
    const auto unknown = robot.relative_position(hal::AgentId{10});
    ASSERT_FALSE(unknown.has_value()) << "10 is a coordinate, not an address";
    EXPECT_EQ(unknown.error().code, Errc::kNotAvailable);
  });
}

TEST(Battery, IsTheGaugesValues) {
  with_readings({{.channel = 3, .values = {0.75, 12, 1, 150, 200}}}, [](hal::Robot& robot) {
    EXPECT_EQ(robot.battery().value_or(0), 0.75);
    EXPECT_EQ(robot.battery_energy().value_or(0), 150);
    EXPECT_EQ(robot.battery_capacity().value_or(0), 200);
  });
}

TEST(Battery, OfWhichTheGaugeDoesNotKnowTheEnergyHasNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  with_readings({{.channel = 3, .values = {0.75, 12, 1, nan, nan}}}, [](hal::Robot& robot) {
    EXPECT_EQ(robot.battery().value_or(0), 0.75);
    EXPECT_EQ(robot.battery_energy().error().code, Errc::kNotAvailable);
    EXPECT_EQ(robot.battery_capacity().error().code, Errc::kNotAvailable);
  });
}

TEST(Readings, AreNotAvailableBeforeTheFirstSample) {
  with_readings({}, [](hal::Robot& robot) {
    EXPECT_EQ(robot.infrared().error().code, Errc::kNotAvailable);
    EXPECT_EQ(robot.odometry().error().code, Errc::kNotAvailable);
    EXPECT_EQ(robot.battery().error().code, Errc::kNotAvailable);
    EXPECT_EQ(robot.battery_energy().error().code, Errc::kNotAvailable);
    EXPECT_EQ(robot.battery_capacity().error().code, Errc::kNotAvailable);
    EXPECT_EQ(robot.relative_position(hal::AgentId{1}).error().code, Errc::kNotAvailable);
    EXPECT_EQ(robot.reading("infrared").error().message,
              "channel 'infrared' has not been sampled yet");
    EXPECT_EQ(robot.reading("lidar").error().message,
              "no channel 'lidar': the agent has none or it was not asked for");
  });
}

TEST(Readings, AreHeldUntilTheNextSample) {
  std::vector<double> charges;
  Scripted::next() = {
      .step = [&](hal::Robot& robot) { charges.push_back(robot.battery().value_or(-1)); }};
  tests::OneAgent agent(Scripted::kind(), tests::robot_session());
  for (const double charge : {0.9, 0.0, 0.8}) {
    auto event = agent.event(hal::node::exchange::ControlDue{});
    if (charge > 0) event.readings = {{.channel = 3, .values = {charge, 12, 1, 200 * charge, 200}}};
    agent.feed(event);
  }
  EXPECT_EQ(charges, (std::vector{0.9, 0.9, 0.8}));
}

TEST(Readings, ThatAreLostAreNotAvailableUntilTheyAreBack) {
  const hal::node::exchange::Reading odometry{2, {1, 2, 3, 4, 5, 6}}, places{1, {3, 10, 11}};
  const hal::node::exchange::Reading no_odometry{2, {}, true}, no_places{1, {}, true};
  with_readings({odometry, places, no_odometry, no_places}, [](hal::Robot& robot) {
    EXPECT_EQ(robot.odometry().error().code, Errc::kNotAvailable);
    EXPECT_EQ(robot.relative_position(hal::AgentId{3}).error().code, Errc::kNotAvailable);
    EXPECT_EQ(robot.reading("odometry").error().message,
              "channel 'odometry' is lost: its device gives no new reading");
  });
  with_readings({no_odometry, odometry},
                [](hal::Robot& robot) { EXPECT_EQ(robot.odometry()->pose.x, 1); });
}

TEST(Readings, OfAnotherLengthOrChannelAreLoggedAndLeftOut) {
  Scripted::next() = {};
  tests::OneAgent agent(Scripted::kind(), tests::robot_session());
  auto event = agent.event(hal::node::exchange::ControlDue{});
  event.readings = {{.channel = 0, .values = {1, 2}}, {.channel = 9, .values = {1}}};
  const auto lines = tests::texts<Log>(agent.feed(event));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0], "r0: a reading of channel 'infrared' with 2 values instead of 6");
  EXPECT_EQ(lines[1], "r0: a reading of channel 9, which is not in the session");
}

}  // namespace
