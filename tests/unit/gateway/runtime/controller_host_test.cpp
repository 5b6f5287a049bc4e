#include "gateway/runtime/controller_host.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

#include "gateway/runtime/in_process_port.h"
#include "tests/unit/gateway/runtime/one_agent.h"
#include "tests/unit/gateway/runtime/scripted.h"

namespace {

using gateway::runtime::ControllerHost;
using hal::AgentId;
using hal::node::exchange::ControlDue;
using hal::node::exchange::ControllerFailed;
using hal::node::exchange::LinkChanged;
using hal::node::exchange::Notice;
using hal::node::exchange::Start;
using hal::node::exchange::Stop;
using tests::Actions;
using tests::Scripted;

TEST(ControllerHost, MakesTheCallbackThatAnEventStandsFor) {
  std::string calls;
  Scripted::next() = {
      .start = [&](hal::Robot&) { calls += "start "; },
      .step = [&](hal::Robot&) { calls += "step "; },
      .receive = [&](hal::Robot&, const hal::Message& m) { calls += "receive:" + m.topic + " "; },
      .notice =
          [&](hal::Robot&, hal::MessageId id, hal::Fate fate) {
            calls += "notice:" + std::to_string(id) + (fate == hal::Fate::kFailed ? "! " : " ");
          },
      .stop = [&](hal::Robot&) { calls += "stop "; }};
  tests::OneAgent agent(Scripted::kind(), tests::robot_session());
  agent.start();
  agent.hear(AgentId{1}, "help", {});
  agent.feed(agent.event(Notice{7, hal::Fate::kFailed}));
  agent.feed(agent.event(LinkChanged{}));
  agent.control();
  agent.feed(agent.event(Stop{}));
  agent.control();
  EXPECT_EQ(calls, "start receive:help notice:7! step stop ") << "nothing follows stop";
}

TEST(ControllerHost, HandsNothingMoreToAnAgentWhoseControllerCannotBeMadeAnew) {
  std::string calls;
  Scripted::next() = {.start = [&](hal::Robot&) { calls += "start "; },
                      .step = [&](hal::Robot&) { calls += "step "; }};
  const hal::ControllerKind kind = Scripted::kind();  // used once more
  tests::OneAgent agent(kind, tests::robot_session());
  agent.start();
  Scripted::next() = {.construct = [](hal::Robot&) { throw std::runtime_error("no camera"); }};
  const Actions actions = agent.start();
  Scripted::next() = {};
  agent.control();
  EXPECT_EQ(tests::texts<ControllerFailed>(actions), std::vector<std::string>{"r0: no camera"});
  EXPECT_EQ(calls, "start ");
}

hal::node::exchange::Session two_robots() {
  hal::node::exchange::Session session;
  session.agents = {tests::robot_session(), tests::robot_session()};
  session.agents[0].agent = AgentId{1};
  session.agents[0].name = "r1";
  session.agents[1].agent = AgentId{2};
  session.agents[1].name = "r2";
  return session;
}

hal::node::exchange::Step control_of(const std::vector<int>& agents) {
  hal::node::exchange::Step step;
  step.run = 11;
  step.sequence = 22;
  for (const int agent : agents) {
    hal::node::exchange::Event event;
    event.agent = AgentId{static_cast<std::uint16_t>(agent)};
    event.what = ControlDue{};
    step.events.push_back(event);
  }
  return step;
}

TEST(ControllerHost, MarksActionsWithTheirAgentAndEventAndRepliesToTheStep) {
  Scripted::next() = {.step = [](hal::Robot& robot) { robot.state(robot.name()); }};
  auto host = ControllerHost::create(Scripted::kind(), two_robots());
  Scripted::next() = {};
  const auto reply = (*host)->answer(control_of({2, 1, 2}));
  EXPECT_EQ(reply.run, 11U);
  EXPECT_EQ(reply.sequence, 22U);
  ASSERT_EQ(reply.actions.size(), 3U);
  const std::vector<std::pair<int, std::string>> expected = {{2, "r2"}, {1, "r1"}, {2, "r2"}};
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(reply.actions[i].agent.value, expected[i].first);
    EXPECT_EQ(tests::text_of(reply.actions[i]), expected[i].second);
    EXPECT_EQ(reply.actions[i].event, i);
  }
  EXPECT_TRUE((*host)->answer({}).actions.empty()) << "actions leave once";
}

TEST(ControllerHost, ReportsWhatAControllerThrewAndLeavesItAlone) {
  Scripted::next() = {.step = [](hal::Robot& robot) {
    robot.state("before");
    if (robot.id() == AgentId{1}) throw std::runtime_error("out of cheese");
  }};
  auto host = ControllerHost::create(Scripted::kind(), two_robots());
  Scripted::next() = {};
  const Actions first = (*host)->answer(control_of({1, 2})).actions;
  ASSERT_EQ(first.size(), 3U);
  EXPECT_EQ(tests::text_of(first[0]), "before");
  EXPECT_EQ(first[1].agent, AgentId{1});
  EXPECT_EQ(std::get<ControllerFailed>(first[1].what).text, "out of cheese");
  const Actions second = (*host)->answer(control_of({1, 2})).actions;
  ASSERT_EQ(second.size(), 1U) << "agent 1 is dead, agent 2 is not";
  EXPECT_EQ(second[0].agent, AgentId{2});
}

TEST(ControllerHost, NamesAnAgentThatIsNotOfTheSession) {
  Scripted::next() = {};
  auto host = ControllerHost::create(Scripted::kind(), two_robots());
  const Actions actions = (*host)->answer(control_of({9})).actions;
  ASSERT_EQ(actions.size(), 1U);
  EXPECT_EQ(std::get<ControllerFailed>(actions[0].what).text,
            "step 22 has an event for agent 9, which is not of the session");
}

TEST(ControllerHost, DoesNotMakeAControllerForAKindOfAgentItCannotDrive) {
  const auto host =
      ControllerHost::create(Scripted::kind(), tests::session_of(tests::mote_session()));
  ASSERT_FALSE(host.has_value());
  EXPECT_EQ(host.error().code, hal::Errc::kInvalidArgument);
  EXPECT_EQ(host.error().message, "m17: controller scripted does not run on motes");
}

TEST(ControllerHost, NamesEveryAgentWhoseControllerCannotBeMade) {
  Scripted::next() = {.construct = [](hal::Robot&) { throw std::runtime_error("no"); }};
  const auto host = ControllerHost::create(Scripted::kind(), two_robots());
  Scripted::next() = {};
  ASSERT_FALSE(host.has_value());
  EXPECT_EQ(host.error().code, hal::Errc::kController);
  EXPECT_EQ(host.error().message, "r1: no\nr2: no");
}

TEST(Contract, ForbidsCallsFromTheConstructor) {
  Scripted::next() = {.construct = [](hal::Robot& robot) { (void)robot.now(); }};
  const auto host =
      ControllerHost::create(Scripted::kind(), tests::session_of(tests::robot_session()));
  Scripted::next() = {};
  ASSERT_FALSE(host.has_value());
  EXPECT_EQ(host.error().message, "r0: now: called outside a callback of this agent's controller");
}

TEST(Contract, ForbidsCallsBetweenCallbacks) {
  hal::Robot* kept = nullptr;
  Scripted::next() = {.start = [&](hal::Robot& robot) { kept = &robot; }};
  tests::OneAgent agent(Scripted::kind(), tests::robot_session());
  agent.start();
  EXPECT_THROW((void)kept->now(), std::logic_error);
  EXPECT_THROW((void)kept->send(hal::kEveryone, "help", {}), std::logic_error);
  EXPECT_THROW((void)kept->set_body_velocity({}), std::logic_error);
  EXPECT_THROW((void)kept->infrared(), std::logic_error);
  EXPECT_THROW((void)kept->network(), std::logic_error);
}

TEST(Contract, ForbidsCallsOnAnotherAgentsObject) {
  std::map<int, hal::Robot*> robots;
  Scripted::next() = {.start = [&](hal::Robot& robot) { robots[robot.id().value] = &robot; },
                      .step = [&](hal::Robot&) { (void)robots.at(1)->now(); }};
  auto host = ControllerHost::create(Scripted::kind(), two_robots());
  Scripted::next() = {};
  auto start = control_of({1, 2});
  for (auto& event : start.events) event.what = Start{};
  (*host)->answer(start);
  EXPECT_TRUE((*host)->answer(control_of({1})).actions.empty());
  const Actions actions = (*host)->answer(control_of({2})).actions;
  ASSERT_EQ(actions.size(), 1U);
  EXPECT_EQ(tests::text_of(actions[0]),
            "now: called outside a callback of this agent's controller");
}

TEST(Contract, ForbidsCallsFromAnotherThreadWhileACallbackRuns) {
  std::string message;
  Scripted::next() = {.step = [&](hal::Robot& robot) {
    std::thread other([&] {
      try {
        (void)robot.now();
      } catch (const std::logic_error& e) {
        message = e.what();
      }
    });
    other.join();
  }};
  tests::OneAgent agent(Scripted::kind(), tests::robot_session());
  agent.control();
  EXPECT_EQ(message, "now: called from another thread than the callback's");
}

TEST(InProcessPort, AnswersInTheNameOfItsProcess) {
  Scripted::next() = {.step = [](hal::Robot& robot) { robot.state(robot.name()); }};
  auto host = ControllerHost::create(Scripted::kind(), two_robots());
  Scripted::next() = {};
  gateway::runtime::InProcessPort port("scripted.in-process", std::move(*host));
  EXPECT_EQ(port.name(), "scripted.in-process");
  EXPECT_TRUE(port.check_alive().has_value());
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE(port.begin(control_of({2})).has_value());
    const auto reply = port.finish();
    ASSERT_TRUE(reply.has_value());
    EXPECT_EQ(reply->process, "scripted.in-process");
    EXPECT_EQ(reply->sequence, 22U);
    EXPECT_EQ(tests::states(reply->actions), std::vector<std::string>{"r2"});
  }
}

}  // namespace
