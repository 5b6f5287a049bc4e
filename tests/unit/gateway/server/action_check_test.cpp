#include "gateway/server/action_check.h"

#include <gtest/gtest.h>

#include "tests/unit/gateway/server/offers.h"

namespace gateway::server {
namespace {

using hal::node::exchange::Action;

/// The robot r0 (address 4) was granted; a Step with an event for it and one for another.
class ActionOfRobot : public testing::Test {
 protected:
  ActionOfRobot() { action_.agent = hal::AgentId{4}; }

  ActionVerdict verdict() const { return judge(action_, granted_, asked_); }

  const std::vector<hal::node::exchange::AgentSession> granted_{sample_offers().back().session};
  const std::vector<hal::AgentId> asked_{hal::AgentId{4}, hal::AgentId{5}};
  Action action_;
};

TEST_F(ActionOfRobot, IsGoodIfItAnswersAnEventOfItsAgent) {
  EXPECT_EQ(verdict(), ActionVerdict::kGood);
}

TEST_F(ActionOfRobot, IsForeignForAnAgentThatWasNotGranted) {
  action_.agent = hal::AgentId{5};
  EXPECT_EQ(verdict(), ActionVerdict::kForeign);
}

TEST_F(ActionOfRobot, IsMalformedIfItAnswersNoEventOfItsAgent) {
  action_.event = 1;
  EXPECT_EQ(verdict(), ActionVerdict::kMalformed);
  action_.event = 2;
  EXPECT_EQ(verdict(), ActionVerdict::kMalformed);
}

}  // namespace
}  // namespace gateway::server
