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
  }

  std::string mistake(Action::What what) const {
    const auto good = validate({session_.agent, 0, std::move(what)}, session_);
    if (good) return {};
    EXPECT_EQ(good.error().code, Errc::kInvalidArgument);
    return good.error().message;
  }

  AgentSession session_;
  Send message_{.id = 1, .destination = AgentId{5}, .topic = "test", .payload = {}};
};

TEST_F(ValidAction, HasNothingWrong) {
  const std::vector<Action::What> good{DriveBody{},
                                       DriveWheels{{20, -20, 0}},
                                       message_,
                                       Invalidate{AgentId{5}, "test"},
                                       SetTimer{},
                                       SetRadio{},
                                       SetState{"S"},
                                       Log{},
                                       ControllerFailed{"why"},
                                       Record{"distance", 1, {}}};
  EXPECT_EQ(good.size(), std::variant_size_v<Action::What>);
  for (const Action::What& what : good) EXPECT_EQ(mistake(what), "") << name({{}, 0, what});
  message_.destination = kEveryone;
  EXPECT_EQ(mistake(message_), "");
}

TEST_F(ValidAction, DrivesWithNumbersOnly) {
  EXPECT_NE(mistake(DriveBody{{.vx = kNan}}), "");
  EXPECT_NE(mistake(DriveBody{{.vy = kNan}}), "");
  EXPECT_NE(mistake(DriveBody{{.omega = kNan}}), "");
  EXPECT_EQ(mistake(DriveBody{{.vy = -std::numeric_limits<double>::infinity()}}),
            "vy is -inf, it must be finite");
}

TEST_F(ValidAction, TurnsAsManyWheelsAsThereAreNoFasterThanTheyCan) {
  EXPECT_EQ(mistake(DriveWheels{{1, 2}}), "speeds has 2 values, the robot has 3 wheels");
  EXPECT_EQ(mistake(DriveWheels{{1, -20.5, 2}}), "speeds[1] is -20.5 rad/s, the limit is 20 rad/s");
  EXPECT_EQ(mistake(DriveWheels{{1, 2, kNan}}), "speeds[2] is nan rad/s, the limit is 20 rad/s");
}

TEST_F(ValidAction, DrivesNoMote) {
  session_.limits = {};
  EXPECT_EQ(mistake(DriveBody{}), "the agent has no wheels");
  EXPECT_EQ(mistake(DriveWheels{}), "the agent has no wheels");
}

TEST_F(ValidAction, SendsWithAPriorityOf802dot11) {
  message_.priority = Priority{7};
  EXPECT_EQ(mistake(message_), "");
  message_.priority = Priority{8};
  EXPECT_EQ(mistake(message_), "priority is 8, 0 to 7 are allowed");
}

TEST_F(ValidAction, GoesToAnotherAgentOrToEveryone) {
  message_.destination = AgentId{4};
  EXPECT_EQ(mistake(message_), "destination 4 is this agent itself");
  message_.destination = AgentId{};
  EXPECT_EQ(mistake(message_), "destination is 0, agents have addresses from 1");
  message_.destination = AgentId{5};
  message_.id = 0;
  EXPECT_EQ(mistake(message_), "the message has number 0, they are numbered from 1");
}

TEST_F(ValidAction, IsNoLongerThanAMessageMayBe) {
  message_.topic = std::string(kMaxTopic, 't');
  message_.payload.resize(kMaxPayload);
  EXPECT_EQ(mistake(message_), "");
  message_.payload.resize(kMaxPayload + 1);
  EXPECT_EQ(mistake(message_), "payload has 2049 bytes, at most 2048 are allowed");
  message_.payload.clear();
  for (const std::string& topic : {std::string(), std::string(kMaxTopic + 1, 't')}) {
    message_.topic = topic;
    const std::string expected =
        "topic '" + topic + "' has " + std::to_string(topic.size()) + " bytes, 1 to 32 are allowed";
    EXPECT_EQ(mistake(message_), expected);
    EXPECT_EQ(mistake(Invalidate{AgentId{5}, topic}), expected);
  }
  message_.topic = std::string("a\0b", 3);
  EXPECT_EQ(mistake(message_), "topic has a zero byte");
}

TEST_F(ValidAction, RecordsFiniteNumbersUnderNames) {
  std::string name(kMaxRecordedName, 'n');
  EXPECT_EQ(mistake(Record{name, -1e308, {}}), "");
  name += 'n';
  EXPECT_EQ(mistake(Record{name, 1, {}}), "name '" + name + "' has 65 bytes, 1 to 64 are allowed");
  EXPECT_EQ(mistake(Record{"", 1, {}}), "name '' has 0 bytes, 1 to 64 are allowed");
  EXPECT_EQ(mistake(Record{std::string("a\0b", 3), 1, {}}), "name has a zero byte");
  EXPECT_EQ(mistake(Record{"distance", kNan, {}}), "'distance' is nan, it must be finite");
  EXPECT_EQ(mistake(Record{"distance", -std::numeric_limits<double>::infinity(), {}}),
            "'distance' is -inf, it must be finite");
}

}  // namespace
}  // namespace hal::node::exchange
