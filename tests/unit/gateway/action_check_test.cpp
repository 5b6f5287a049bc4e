#include "gateway/action_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hal/types/message.h"
#include "tests/unit/gateway/offers.h"

namespace gateway {
namespace {

using hal::exchange::Action;
using hal::exchange::ActionKind;

/// The robot r0 (address 4) answers an event of its own at 1 s; the next event is another's.
class ActionOfRobot : public testing::Test {
 protected:
  ActionOfRobot() { action_.agent = hal::AgentId{4}; }

  ActionVerdict verdict(ActionKind kind) {
    action_.kind = kind;
    return judge(action_, granted_, asked_);
  }

  const hal::Time second_ = hal::time_from_ns(1'000'000'000);
  const GrantedAgents granted_{{sample_offers().back().session}};
  const std::vector<Asked> asked_{{hal::AgentId{4}, second_}, {hal::AgentId{5}, second_}};
  Action action_;
};

TEST_F(ActionOfRobot, IsGoodIfItKeepsTheRules) {
  EXPECT_EQ(verdict(ActionKind::kDriveBody), ActionVerdict::kGood);
  EXPECT_EQ(verdict(ActionKind::kState), ActionVerdict::kGood);
  action_.wheel_speeds = {1, 2, 3};
  EXPECT_EQ(verdict(ActionKind::kDriveWheels), ActionVerdict::kGood);
  action_.topic = std::string(hal::kMaxTopic, 't');
  action_.payload.resize(hal::kMaxPayload);
  EXPECT_EQ(verdict(ActionKind::kSend), ActionVerdict::kGood);
  action_.at = second_;
  EXPECT_EQ(verdict(ActionKind::kTimer), ActionVerdict::kGood);
}

TEST_F(ActionOfRobot, IsForeignForAnAgentThatWasNotGranted) {
  action_.agent = hal::AgentId{5};
  EXPECT_EQ(verdict(ActionKind::kState), ActionVerdict::kForeign);
}

TEST_F(ActionOfRobot, IsMalformedIfItAnswersNoEventOfItsAgent) {
  action_.event = 1;
  EXPECT_EQ(verdict(ActionKind::kState), ActionVerdict::kMalformed);
  action_.event = 2;
  EXPECT_EQ(verdict(ActionKind::kState), ActionVerdict::kMalformed);
}

TEST_F(ActionOfRobot, IsMalformedIfItIsNotANumber) {
  for (double* component : {&action_.twist.vx, &action_.twist.vy, &action_.twist.omega}) {
    *component = std::nan("");
    EXPECT_EQ(verdict(ActionKind::kDriveBody), ActionVerdict::kMalformed);
    *component = 0;
  }
  action_.wheel_speeds = {1, 2, std::numeric_limits<double>::infinity()};
  EXPECT_EQ(verdict(ActionKind::kDriveWheels), ActionVerdict::kMalformed);
}

TEST_F(ActionOfRobot, IsMalformedIfItHasAnotherNumberOfWheels) {
  action_.wheel_speeds = {1, 2};
  EXPECT_EQ(verdict(ActionKind::kDriveWheels), ActionVerdict::kMalformed);
}

TEST_F(ActionOfRobot, IsMalformedIfItIsTooLong) {
  EXPECT_EQ(verdict(ActionKind::kSend), ActionVerdict::kMalformed);  // No topic.
  action_.topic = std::string(hal::kMaxTopic + 1, 't');
  EXPECT_EQ(verdict(ActionKind::kSend), ActionVerdict::kMalformed);
  EXPECT_EQ(verdict(ActionKind::kInvalidate), ActionVerdict::kMalformed);
  action_.topic.resize(1);
  action_.payload.resize(hal::kMaxPayload + 1);
  EXPECT_EQ(verdict(ActionKind::kSend), ActionVerdict::kMalformed);
}

TEST_F(ActionOfRobot, IsMalformedIfItsTimerIsInThePast) {
  action_.at = second_ - hal::Duration{1};
  EXPECT_EQ(verdict(ActionKind::kTimer), ActionVerdict::kMalformed);
}

}  // namespace
}  // namespace gateway
