#include "sim/agents/controllers.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/printers.h"

namespace {

using hal::AgentId;
using hal::Time;
using hal::exchange::Action;
using hal::exchange::Event;
using hal::exchange::Reply;
using hal::exchange::Step;
using sim::agents::Controllers;

/// A process that answers by a rule, and writes down when it is called.
class RuledPort final : public hal::exchange::ControllerPort {
 public:
  using Rule = std::function<hal::Result<Reply>(const Step&)>;
  RuledPort(std::string name, std::string& calls, Rule rule)
      : name_(std::move(name)), calls_(calls), rule_(std::move(rule)) {}

  const std::string& name() const override { return name_; }
  hal::Result<void> begin(const Step& step) override {
    calls_ += "begin " + name_ + "; ";
    step_ = step;
    return {};
  }
  hal::Result<Reply> finish() override {
    calls_ += "finish " + name_ + "; ";
    return rule_(step_);
  }
  hal::Result<void> check_alive() override { return {}; }

 private:
  std::string name_;
  std::string& calls_;
  Rule rule_;
  Step step_;
};

/// Answers each event with one log action that says the step's sequence.
hal::Result<Reply> echo(const Step& step) {
  Reply reply;
  for (std::uint32_t i = 0; i < step.events.size(); ++i) {
    Action action;
    action.agent = step.events[i].agent;
    action.event = i;
    action.text = std::to_string(step.sequence);
    reply.actions.push_back(action);
  }
  return reply;
}

Event event(std::uint16_t agent, hal::Duration at = {}) {
  Event e;
  e.agent = AgentId{agent};
  e.time = Time{at};
  return e;
}

class ControllersTest : public testing::Test {
 protected:
  void connect(const std::string& name, const std::vector<AgentId>& agents,
               RuledPort::Rule rule = echo) {
    controllers_.connect(std::make_shared<RuledPort>(name, calls_, std::move(rule)), agents);
  }

  std::string calls_;
  Controllers controllers_;
};

TEST_F(ControllersTest, HandsOverToAllBeforeItWaitsForAny) {
  connect("a", {AgentId{1}, AgentId{3}});
  connect("b", {AgentId{2}});
  controllers_.exchange({event(1), event(2)}, Time{});
  EXPECT_EQ(calls_, "begin a; begin b; finish a; finish b; ");
  EXPECT_EQ(controllers_.exchanges(), 2u);
}

TEST_F(ControllersTest, ProcessesWithoutEventsAreLeftAlone) {
  connect("a", {AgentId{1}});
  connect("b", {AgentId{2}});
  controllers_.exchange({event(2)}, Time{});
  EXPECT_EQ(calls_, "begin b; finish b; ");
}

TEST_F(ControllersTest, AnswersComeByAgentHoweverAgentsShareProcesses) {
  connect("a", {AgentId{1}, AgentId{3}});
  connect("b", {AgentId{2}});
  const auto round = controllers_.exchange({event(1), event(2), event(3)}, Time{});
  ASSERT_EQ(round.answers.size(), 3u);
  for (std::uint16_t i = 0; i < 3; ++i) {
    EXPECT_EQ(round.answers[i].action.agent, AgentId{static_cast<std::uint16_t>(i + 1)});
  }
}

TEST_F(ControllersTest, SequenceNumbersCountPerProcess) {
  connect("a", {AgentId{1}});
  connect("b", {AgentId{2}});
  controllers_.exchange({event(1)}, Time{});
  const auto round = controllers_.exchange({event(1), event(2)}, Time{});
  EXPECT_EQ(round.answers[0].action.text, "2");
  EXPECT_EQ(round.answers[1].action.text, "1");
}

TEST_F(ControllersTest, AFailedProcessIsNamedAndTheOthersAreHeard) {
  connect("a", {AgentId{1}}, [](const Step&) -> hal::Result<Reply> {
    return hal::fail(hal::Errc::kTimeout, "a is silent");
  });
  connect("b", {AgentId{2}});
  auto round = controllers_.exchange({event(1), event(2)}, Time{});
  ASSERT_EQ(round.failures.size(), 1u);
  EXPECT_EQ(round.failures[0].error.message, "a is silent");
  EXPECT_EQ(round.answers.size(), 1u);

  controllers_.drop(round.failures[0].port);
  calls_.clear();
  round = controllers_.exchange({event(1), event(2)}, Time{});
  EXPECT_TRUE(round.failures.empty());
  EXPECT_EQ(calls_, "begin b; finish b; ");
}

}  // namespace
