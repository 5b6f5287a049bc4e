#include "sim/agents/controllers.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/printers.h"
#include "tests/support/scripted_port.h"

namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;
using hal::node::exchange::Action;
using hal::node::exchange::Event;
using sim::agents::Controllers;
using tests::ScriptedPort;

/// Answers each event with one log action.
std::vector<Action> echo(const Event&) { return {Action{}}; }

Event event(std::uint16_t agent, hal::Duration at = {}) {
  Event e;
  e.agent = AgentId{agent};
  e.time = Time{at};
  return e;
}

class ControllersTest : public testing::Test {
 protected:
  std::shared_ptr<ScriptedPort> connect(const std::string& name,
                                        const std::vector<AgentId>& agents) {
    auto port = std::make_shared<ScriptedPort>(echo, name, &calls_);
    controllers_.connect(port, agents);
    return port;
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
  const auto a = connect("a", {AgentId{1}});
  const auto b = connect("b", {AgentId{2}});
  controllers_.exchange({event(1)}, Time{});
  controllers_.exchange({event(1), event(2)}, Time{});
  EXPECT_EQ(a->steps.back().sequence, 2u);
  EXPECT_EQ(b->steps.back().sequence, 1u);
}

TEST_F(ControllersTest, AFailedProcessIsNamedAndTheOthersAreHeard) {
  connect("a", {AgentId{1}})->dead = true;
  connect("b", {AgentId{2}});
  auto round = controllers_.exchange({event(1), event(2)}, Time{});
  ASSERT_EQ(round.failures.size(), 1u);
  EXPECT_EQ(round.failures[0].error.message, "killed by signal 9");
  EXPECT_EQ(round.answers.size(), 1u);

  controllers_.drop(round.failures[0].port);
  calls_.clear();
  round = controllers_.exchange({event(1), event(2)}, Time{});
  EXPECT_TRUE(round.failures.empty());
  EXPECT_EQ(calls_, "begin b; finish b; ");
}

/// One that shares the simulated time, and does not answer.
std::shared_ptr<ScriptedPort> connect_waiting(Controllers& controllers) {
  auto port = std::make_shared<ScriptedPort>(echo, "a");
  port->shares = true;
  port->answers = 0;
  controllers.connect(port, {AgentId{1}});
  return port;
}

TEST_F(ControllersTest, AProcessThatSharesTheTimeMayAnswerLaterAndItsEventsWait) {
  const auto a = connect_waiting(controllers_);
  connect("b", {AgentId{2}});
  EXPECT_TRUE(controllers_.share_time());
  EXPECT_FALSE(controllers_.is_one_awaited());
  EXPECT_EQ(controllers_.exchange({event(1, 1s), event(2, 1s)}, Time{1s}).answers.size(), 1u);
  EXPECT_TRUE(controllers_.is_one_awaited());
  EXPECT_TRUE(controllers_.exchange({event(1, 2s), event(1, 3s)}, Time{3s}).answers.empty());
  EXPECT_EQ(a->steps.size(), 1u);

  a->answers.reset();
  const auto round = controllers_.exchange({}, Time{4s});
  EXPECT_FALSE(controllers_.is_one_awaited());
  ASSERT_EQ(round.answers.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(round.answers[i].event_time, Time{std::chrono::seconds{i + 1}});
  }
  EXPECT_EQ(a->steps.size(), 2u) << "what waited goes together";
  EXPECT_EQ(controllers_.exchanges(), 3u);
  EXPECT_TRUE(controllers_.complaints().empty());
}

TEST_F(ControllersTest, OneThatNeverAnswersIsNamedAtTheEndWithWhatItHasMissed) {
  connect_waiting(controllers_);
  Event control = event(1);
  control.what = hal::node::exchange::ControlDue{};
  for (int i = 0; i < 4; ++i) {
    auto events = std::vector{control};
    controllers_.exchange(events, Time{});
  }
  EXPECT_EQ(
      controllers_.complaints(),
      (std::vector<std::string>{"at the stop: process 'a' waits for simulated time, which is over",
                                "process 'a' waited in its callbacks; control cycles missed: 2"}));
}

TEST_F(ControllersTest, ThereIsNoWaitForOneThatDies) {
  const auto a = connect_waiting(controllers_);
  controllers_.exchange({event(1)}, Time{});
  a->dead = true;
  const auto round = controllers_.exchange({}, Time{});
  ASSERT_EQ(round.failures.size(), 1u);
  controllers_.drop(round.failures[0].port);
  EXPECT_FALSE(controllers_.is_one_awaited());
  EXPECT_TRUE(controllers_.exchange({event(1)}, Time{}).failures.empty());
}

}  // namespace
