#include "gateway/server/inside_port.h"
#include "tests/support/exchange.h"

#include <gtest/gtest.h>

#include <vector>

namespace gateway::server {
namespace {

using hal::node::exchange::Action;
using hal::node::exchange::Reply;
using hal::node::exchange::Step;

constexpr hal::AgentId kRobot{4}, kOther{5};

Step step_of(std::uint64_t sequence) {
  Step step;
  step.run = 7;
  step.sequence = sequence;
  step.events.resize(1);
  step.events[0].agent = kRobot;
  return step;
}

Reply reply_of(hal::AgentId agent, std::uint32_t event, const std::string& text) {
  Reply reply;
  reply.actions.resize(1);
  reply.actions[0].agent = agent;
  reply.actions[0].event = event;
  reply.actions[0].what = hal::node::exchange::SetState{text};
  return reply;
}

/// Answers at the second time of asking.
class SlowPort final : public hal::node::exchange::ControllerPort {
 public:
  const std::string& name() const override { return name_; }
  hal::Result<void> begin(const Step&) override { return {}; }
  hal::Result<Reply> finish() override { return reply_of(kRobot, 0, "finish"); }
  hal::Result<std::optional<Reply>> try_finish() override {
    if (++asked_ < 2) return std::nullopt;
    return reply_of(kRobot, 0, "try_finish");
  }
  hal::Result<void> check_alive() override { return {}; }

 private:
  std::string name_ = "slow";
  int asked_ = 0;
};

TEST(RecordedPort, TellsOfEachAnswerOnce) {
  std::vector<std::string> told;
  RecordedPort port(std::make_shared<SlowPort>(),
                    [&](const Reply& reply) { told.push_back(tests::text_of(reply.actions[0])); });
  EXPECT_EQ(port.name(), "slow");
  EXPECT_FALSE(port.try_finish()->has_value());
  EXPECT_TRUE(port.try_finish()->has_value());
  EXPECT_TRUE(port.finish());
  EXPECT_EQ(told, (std::vector<std::string>{"try_finish", "finish"}));
}

TEST(RepeatedPort, GivesTheAnswersOfTheRecordInTheirOrder) {
  int told = 0;
  RepeatedPort port("robot",
                    {{{}, reply_of(kRobot, 0, "first")}, {{}, reply_of(kRobot, 0, "second")}},
                    [&](const Reply&) { ++told; });
  for (const auto& [sequence, text] : {std::pair{1U, "first"}, std::pair{2U, "second"}}) {
    ASSERT_TRUE(port.begin(step_of(sequence)));
    const auto reply = port.finish();
    ASSERT_TRUE(reply);
    EXPECT_EQ(tests::text_of(reply->actions[0]), text);
    EXPECT_EQ(reply->sequence, sequence);
    EXPECT_EQ(reply->run, 7U);
  }
  EXPECT_EQ(told, 2);
  ASSERT_TRUE(port.begin(step_of(3)));
  EXPECT_EQ(port.finish().error().message, "the record has no further answer of 'robot'");
}

TEST(RepeatedPort, DamageOfTheRecordIsAnError) {
  for (const auto& [agent, event] : {std::pair{kRobot, 1U}, std::pair{kOther, 0U}}) {
    RepeatedPort port("robot", {{{}, reply_of(agent, event, "")}}, [](const Reply&) {});
    ASSERT_TRUE(port.begin(step_of(1)));
    EXPECT_EQ(port.finish().error().message,
              "an answer of 'robot' in the record is to another Step");
  }
}

TEST(RepeatedPort, InLockStepTheAnswerComesWhenTheRunGotIt) {
  using namespace std::chrono_literals;
  hal::Time now{1s};
  std::vector<hal::Time> stops;
  RepeatedPort port(
      "robot",
      {{hal::Time{1s}, reply_of(kRobot, 0, "at once")},
       {hal::Time{3s}, reply_of(kRobot, 0, "late")}},
      [](const Reply&) {},
      RepeatedTime{.now = [&] { return now; },
                   .stop_at = [&](hal::Time at) { stops.push_back(at); }});
  EXPECT_TRUE(port.shares_time());
  ASSERT_TRUE(port.begin(step_of(1)));
  EXPECT_TRUE(port.try_finish()->has_value());
  EXPECT_TRUE(stops.empty());
  ASSERT_TRUE(port.begin(step_of(2)));
  EXPECT_EQ(stops, std::vector{hal::Time{3s}});
  EXPECT_FALSE(port.try_finish()->has_value());
  now = hal::Time{3s};
  const auto late = port.try_finish();
  ASSERT_TRUE(late->has_value());
  EXPECT_EQ(tests::text_of((*late)->actions[0]), "late");
}

}  // namespace
}  // namespace gateway::server
