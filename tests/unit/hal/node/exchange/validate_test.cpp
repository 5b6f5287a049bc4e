#include "hal/node/exchange/validate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hal/types/message.h"
#include "hal/types/record.h"

namespace hal::node::exchange {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Robot 4 with three wheels that turn at up to 20 rad/s, and what is wrong with an action of it.
class ValidAction : public testing::Test {
 protected:
  ValidAction() {
    session_.agent = AgentId{4};
    session_.kind = AgentKind::kRobot;
    session_.limits = {
        .body_to_wheel = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .wheel_to_body = {}, .wheel_speed = 20};
    action_.agent = AgentId{4};
    action_.message_id = 1;
    action_.destination = AgentId{5};
    action_.topic = "test";
    action_.text = "distance";
  }

  std::string mistake(ActionKind kind) {
    action_.kind = kind;
    const auto good = validate(action_, session_);
    if (good) return {};
    EXPECT_EQ(good.error().code, Errc::kInvalidArgument);
    return good.error().message;
  }

  AgentSession session_;
  Action action_;
};

TEST_F(ValidAction, HasNothingWrong) {
  for (const ActionKind kind : {ActionKind::kDriveBody, ActionKind::kSend, ActionKind::kInvalidate,
                                ActionKind::kTimer, ActionKind::kRadio, ActionKind::kState,
                                ActionKind::kLog, ActionKind::kError, ActionKind::kRecord}) {
    EXPECT_EQ(mistake(kind), "") << name(kind);
  }
  action_.wheel_speeds = {20, -20, 0};
  EXPECT_EQ(mistake(ActionKind::kDriveWheels), "");
  action_.destination = kEveryone;
  EXPECT_EQ(mistake(ActionKind::kSend), "");
}

TEST_F(ValidAction, DrivesWithNumbersOnly) {
  for (double* component : {&action_.twist.vx, &action_.twist.vy, &action_.twist.omega}) {
    *component = kNan;
    EXPECT_NE(mistake(ActionKind::kDriveBody), "");
    *component = 0;
  }
  action_.twist.vy = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(mistake(ActionKind::kDriveBody), "vy is -inf, it must be finite");
}

TEST_F(ValidAction, TurnsAsManyWheelsAsThereAreNoFasterThanTheyCan) {
  action_.wheel_speeds = {1, 2};
  EXPECT_EQ(mistake(ActionKind::kDriveWheels), "speeds has 2 values, the robot has 3 wheels");
  action_.wheel_speeds = {1, -20.5, 2};
  EXPECT_EQ(mistake(ActionKind::kDriveWheels), "speeds[1] is -20.5 rad/s, the limit is 20 rad/s");
  action_.wheel_speeds = {1, 2, kNan};
  EXPECT_EQ(mistake(ActionKind::kDriveWheels), "speeds[2] is nan rad/s, the limit is 20 rad/s");
}

TEST_F(ValidAction, DrivesNoMote) {
  session_.limits = {};
  EXPECT_EQ(mistake(ActionKind::kDriveBody), "the agent has no wheels");
  EXPECT_EQ(mistake(ActionKind::kDriveWheels), "the agent has no wheels");
}

TEST_F(ValidAction, GoesToAnotherAgentOrToEveryone) {
  action_.destination = AgentId{4};
  EXPECT_EQ(mistake(ActionKind::kSend), "destination 4 is this agent itself");
  action_.destination = AgentId{};
  EXPECT_EQ(mistake(ActionKind::kSend), "destination is 0, agents have addresses from 1");
  action_.destination = AgentId{5};
  action_.message_id = 0;
  EXPECT_EQ(mistake(ActionKind::kSend), "the message has number 0, they are numbered from 1");
}

TEST_F(ValidAction, IsNoLongerThanAMessageMayBe) {
  action_.topic = std::string(kMaxTopic, 't');
  action_.payload.resize(kMaxPayload);
  EXPECT_EQ(mistake(ActionKind::kSend), "");
  action_.payload.resize(kMaxPayload + 1);
  EXPECT_EQ(mistake(ActionKind::kSend), "payload has 2049 bytes, at most 2048 are allowed");
  action_.payload.clear();
  for (const std::string& topic : {std::string(), std::string(kMaxTopic + 1, 't')}) {
    action_.topic = topic;
    const std::string expected =
        "topic '" + topic + "' has " + std::to_string(topic.size()) + " bytes, 1 to 32 are allowed";
    EXPECT_EQ(mistake(ActionKind::kSend), expected);
    EXPECT_EQ(mistake(ActionKind::kInvalidate), expected);
  }
  action_.topic = std::string("a\0b", 3);
  EXPECT_EQ(mistake(ActionKind::kSend), "topic has a zero byte");
}

TEST_F(ValidAction, RecordsFiniteNumbersUnderNames) {
  action_.text = std::string(kMaxRecordedName, 'n');
  action_.value = -1e308;
  EXPECT_EQ(mistake(ActionKind::kRecord), "");
  action_.text += 'n';
  EXPECT_EQ(mistake(ActionKind::kRecord),
            "name '" + action_.text + "' has 65 bytes, 1 to 64 are allowed");
  action_.text.clear();
  EXPECT_EQ(mistake(ActionKind::kRecord), "name '' has 0 bytes, 1 to 64 are allowed");
  action_.text = std::string("a\0b", 3);
  EXPECT_EQ(mistake(ActionKind::kRecord), "name has a zero byte");
  action_.text = "distance";
  action_.value = kNan;
  EXPECT_EQ(mistake(ActionKind::kRecord), "'distance' is nan, it must be finite");
  action_.value = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(mistake(ActionKind::kRecord), "'distance' is -inf, it must be finite");
}

}  // namespace
}  // namespace hal::node::exchange
