#include <gtest/gtest.h>

#include "tests/unit/gateway/runtime/one_agent.h"
#include "tests/unit/gateway/runtime/scripted.h"

namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Errc;
namespace exchange = hal::node::exchange;
using tests::Actions;
using tests::Scripted;

Actions actions_of(std::function<void(hal::Robot&)> step) {
  Scripted::next() = {.step = std::move(step)};
  tests::OneAgent agent(Scripted::kind(), tests::robot_session());
  return agent.control();
}

TEST(Object, KnowsItselfFromTheSession) {
  actions_of([](hal::Robot& robot) {
    EXPECT_EQ(robot.id(), AgentId{26});
    EXPECT_EQ(robot.name(), "r0");
    EXPECT_EQ(robot.control_period(), 100ms);
    EXPECT_EQ(robot.air_interface(), "");
    EXPECT_EQ(robot.channels().size(), 4U);
  });
}

TEST(Object, NowIsTheTimeOfTheEvent) {
  std::vector<hal::Time> times;
  Scripted::next() = {.step = [&](hal::Robot& robot) { times.push_back(robot.now()); }};
  tests::OneAgent agent(Scripted::kind(), tests::robot_session());
  agent.control();
  agent.now = hal::Time{300ms};
  agent.control();
  EXPECT_EQ(times, (std::vector{hal::Time{}, hal::Time{300ms}}));
}

TEST(Object, DrawsFromTheStreamOfTheSeedAndTheAgentsName) {
  hal::RandomStream expected(1, "r0/controller");
  actions_of([&](hal::Robot& robot) {
    EXPECT_EQ(robot.random().next(), expected.next());
    EXPECT_EQ(robot.random().next(), expected.next());
  });
}

TEST(Send, NumbersMessagesFromOneAndSkipsRefusedOnes) {
  const hal::Bytes payload{1, 2, 3};
  const Actions actions = actions_of([&](hal::Robot& robot) {
    EXPECT_EQ(robot.send(AgentId{3}, "help", payload).value_or(0), 1U);
    EXPECT_FALSE(robot.send(AgentId{3}, "", payload).has_value());
    EXPECT_EQ(robot.send(hal::kEveryone, "help", {}).value_or(0), 2U);
  });
  ASSERT_EQ(actions.size(), 3U);
  EXPECT_EQ(std::get<exchange::Send>(actions[0].what),
            (exchange::Send{1, AgentId{3}, "help", payload}));
  EXPECT_EQ(std::get<exchange::Send>(actions[2].what).id, 2U);
}

TEST(Send, HasThePriorityThatTheControllerChooses) {
  const Actions actions = actions_of([](hal::Robot& robot) {
    EXPECT_TRUE(robot.send(AgentId{3}, "help", {}, {.priority = hal::Priority::kVoice}));
    EXPECT_TRUE(robot.send(AgentId{3}, "help", {}));
    EXPECT_FALSE(robot.send(AgentId{3}, "help", {}, {.priority = hal::Priority{8}}));
  });
  ASSERT_EQ(actions.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<exchange::Log>(actions[2].what)) << "why it is refused";
  EXPECT_EQ(std::get<exchange::Send>(actions[0].what).priority, hal::Priority::kVoice);
  EXPECT_EQ(std::get<exchange::Send>(actions[1].what).priority, hal::Priority::kBestEffort);
}

TEST(Send, TakesTheTopicsThatAnAgentMayUseAndDoesNotFloodTheLogWithThoseTooMany) {
  int granted = 0, refused = 0;
  std::string why;
  const Actions actions = actions_of([&](hal::Robot& robot) {
    for (int round = 0; round < 2; ++round) {  // a topic that was granted stays granted
      for (std::size_t i = 0; i < hal::kMaxTopics + 10; ++i) {
        const auto sent = robot.send(AgentId{3}, "topic " + std::to_string(i), {});
        ++(sent ? granted : refused);
        if (sent) continue;
        EXPECT_EQ(sent.error().code, Errc::kInvalidArgument);
        if (why.empty()) why = sent.error().message;
      }
    }
  });
  EXPECT_EQ(granted, 2 * static_cast<int>(hal::kMaxTopics));
  EXPECT_EQ(refused, 20);
  EXPECT_EQ(why, "r0: send: 'topic 256' would be topic 257 of this agent, at most 256 are allowed");
  EXPECT_EQ(tests::texts<exchange::Log>(actions),
            (std::vector<std::string>{why,
                                      "r0: send: 'topic 265' would be topic 257 of this agent, at "
                                      "most 256 are allowed (10 times by now)"}));
}

TEST(State, OneThatIsNotDeclaredIsRefusedAndToldOnce) {
  Scripted::next() = {.step = [](hal::Robot& robot) {
    robot.state("GOES");
    robot.state("FLIES");
    robot.state("FLIES");
    robot.state("SWIMS");
    robot.state("STANDS");
  }};
  hal::ControllerKind kind = Scripted::kind();
  kind.states = {"STANDS", "GOES"};
  tests::OneAgent agent(kind, tests::robot_session());
  const Actions actions = agent.control();
  EXPECT_EQ(tests::states(actions), (std::vector<std::string>{"GOES", "STANDS"}));
  EXPECT_EQ(tests::texts<exchange::Log>(actions),
            std::vector<std::string>{"r0: state: 'FLIES' is not one of the states that the "
                                     "controller declares: STANDS, GOES"});
}

TEST(Record, OneThatIsNotDeclaredIsRefusedAndToldOnce) {
  Scripted::next() = {.step = [](hal::Robot& robot) {
    robot.record("need", 0.5);
    robot.record("knead", 1);
    robot.record("knead", 2);
    robot.record("distance", 3);
  }};
  hal::ControllerKind kind = Scripted::kind();
  kind.records = {{"distance", "m", "To the caller."}, {"need", "1", "How much it is needed."}};
  tests::OneAgent agent(kind, tests::robot_session());
  const Actions actions = agent.control();
  EXPECT_EQ(tests::texts<exchange::Record>(actions),
            (std::vector<std::string>{"need", "distance"}));
  EXPECT_EQ(tests::texts<exchange::Log>(actions),
            std::vector<std::string>{"r0: record: 'knead' is not one of the values that the "
                                     "controller declares: distance, need"});
}

TEST(Send, TakesTheLongestTopicAndPayloadAndRefusesOneByteMore) {
  const hal::Bytes longest(hal::kMaxPayload);
  const hal::Bytes too_long(hal::kMaxPayload + 1);
  const std::string topic(hal::kMaxTopic, 't');
  const Actions actions = actions_of([&](hal::Robot& robot) {
    EXPECT_TRUE(robot.send(AgentId{3}, topic, longest).has_value());
    const auto payload = robot.send(AgentId{3}, topic, too_long);
    ASSERT_FALSE(payload.has_value());
    EXPECT_EQ(payload.error().code, Errc::kInvalidArgument);
    EXPECT_FALSE(robot.send(AgentId{3}, topic + "t", longest).has_value());
  });
  const auto lines = tests::texts<exchange::Log>(actions);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0], "r0: send: payload has 2049 bytes, at most 2048 are allowed");
  EXPECT_EQ(lines[1], "r0: send: topic '" + topic + "t' has 33 bytes, 1 to 32 are allowed");
}

TEST(Send, RefusesAMessageToItself) {
  const Actions actions = actions_of(
      [](hal::Robot& robot) { EXPECT_FALSE(robot.send(robot.id(), "help", {}).has_value()); });
  EXPECT_EQ(tests::texts<exchange::Log>(actions),
            std::vector<std::string>{"r0: send: destination 26 is this agent itself"});
}

TEST(Send, RefusesAddressZeroAtOnceAndPromisesNoNotice) {
  const Actions actions = actions_of([](hal::Robot& robot) {
    const auto sent = robot.send(AgentId{}, "help", {});
    ASSERT_FALSE(sent.has_value());
    EXPECT_EQ(sent.error().code, Errc::kInvalidArgument);
    EXPECT_EQ(robot.send(AgentId{3}, "help", {}).value(), 1U) << "the number is not used up";
  });
  EXPECT_EQ(tests::texts<exchange::Log>(actions),
            std::vector<std::string>{"r0: send: destination is 0, agents have addresses from 1"});
}

TEST(SetTimer, RefusesThePastAndTakesThePresent) {
  Scripted::next() = {.step = [](hal::Robot& robot) {
    EXPECT_TRUE(robot.set_timer(4, robot.now()).has_value());
    EXPECT_EQ(robot.set_timer(5, robot.now() - 1ns).error().code, Errc::kInvalidArgument);
  }};
  tests::OneAgent agent(Scripted::kind(), tests::robot_session());
  agent.now = hal::Time{2s};
  const Actions actions = agent.control();
  ASSERT_EQ(actions.size(), 2U);
  EXPECT_EQ(std::get<exchange::SetTimer>(actions[0].what), (exchange::SetTimer{4, agent.now}));
  EXPECT_EQ(tests::text_of(actions[1]),
            "r0: set_timer: timer 5: at 1.999999999 s is before now, 2 s");
}

/// Sets timer 1 to `first`, moves it to `second`, and hands over timer events at 1, 2 and 3 s, as a
/// host would that learns of the move too late. @return times of the callbacks.
std::vector<hal::Time> timer_calls(hal::Time first, hal::Time second) {
  std::vector<hal::Time> calls;
  Scripted::next() = {.start =
                          [&](hal::Robot& robot) {
                            EXPECT_TRUE(robot.set_timer(1, first).has_value());
                            EXPECT_TRUE(robot.set_timer(1, second).has_value());
                          },
                      .timer =
                          [&](hal::Robot& robot, hal::TimerId id) {
                            EXPECT_EQ(id, 1U);
                            calls.push_back(robot.now());
                          }};
  tests::OneAgent agent(Scripted::kind(), tests::robot_session());
  agent.start();
  for (const auto at : {1s, 2s, 3s}) {
    agent.now = hal::Time{at};
    agent.feed(agent.event(exchange::TimerDue{1}));
  }
  return calls;
}

TEST(SetTimer, CallsBackOnceAndNotBeforeTheTimeItWasMovedTo) {
  EXPECT_EQ(timer_calls(hal::Time{1s}, hal::Time{2s}), std::vector{hal::Time{2s}});
  EXPECT_EQ(timer_calls(hal::Time{3s}, hal::Time{1s}), std::vector{hal::Time{1s}});
}

TEST(State, IsCutTo64BytesBetweenCharacters) {
  const std::string ascii(70, 'a');
  const std::string umlauts = std::string(63, 'a') + "\xC3\xA4";  // the 64th byte is half an ä
  const Actions actions = actions_of([&](hal::Robot& robot) {
    robot.state("GO");
    robot.state(ascii);
    robot.state(umlauts);
  });
  const std::vector<std::string> expected{"GO", std::string(64, 'a'), std::string(63, 'a')};
  EXPECT_EQ(tests::states(actions), expected);
}

// DDS ends strings there: in process must not be different.
TEST(ZeroBytes, EndTextsAndAreRefusedInTopics) {
  const std::string zero("a\0b", 3);
  const Actions actions = actions_of([&](hal::Robot& robot) {
    robot.state(zero);
    EXPECT_FALSE(robot.send(AgentId{3}, zero, {}).has_value());
  });
  EXPECT_EQ(tests::states(actions), std::vector<std::string>{"a"});
  EXPECT_EQ(tests::texts<exchange::Log>(actions),
            std::vector<std::string>{"r0: send: topic has a zero byte"});
}

TEST(State, WithoutANameIsRefused) {
  const Actions actions = actions_of([](hal::Robot& robot) { robot.state(""); });
  EXPECT_EQ(tests::texts<exchange::Log>(actions),
            std::vector<std::string>{"r0: state: name is empty, 1 to 64 bytes are allowed"});
  EXPECT_TRUE(tests::states(actions).empty());
}

TEST(Names, AreKnownToAControllerThatAsked) {
  Scripted::next() = {.step = [](hal::Robot& robot) {
    EXPECT_EQ(robot.address_of("m17"), AgentId{17});
    EXPECT_EQ(robot.address_of("r0"), robot.id());
    EXPECT_EQ(robot.address_of("m18"), std::nullopt);
    EXPECT_EQ(robot.name_of(AgentId{17}), "m17");
    EXPECT_EQ(robot.name_of(AgentId{18}), std::nullopt);
    EXPECT_EQ(robot.name_of(hal::kEveryone), std::nullopt);
  }};
  hal::ControllerKind kind = Scripted::kind();
  kind.wants.names = true;
  tests::OneAgent agent(kind, tests::robot_session(), {{AgentId{26}, "r0"}, {AgentId{17}, "m17"}});
  EXPECT_TRUE(agent.control().empty()) << "unknown is no mistake";
}

TEST(Names, AreUnknownToAControllerThatDidNotAskAndItIsToldWhyOnce) {
  const Actions actions = actions_of([](hal::Robot& robot) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(robot.address_of("r0"), std::nullopt);
      EXPECT_EQ(robot.name_of(AgentId{26}), std::nullopt);
    }
  });
  const std::string why = "the controller did not ask for it: .wants = {.names = true}";
  EXPECT_EQ(tests::texts<exchange::Log>(actions),
            (std::vector<std::string>{"r0: address_of: " + why, "r0: name_of: " + why}));
}

TEST(Record, TakesFiniteNumbersWithTheTimeOfTheEvent) {
  Scripted::next() = {.step = [](hal::Robot& robot) {
    robot.record("distance", -0.25);
    robot.record("distance", std::numeric_limits<double>::quiet_NaN());
    robot.record("", 1);
  }};
  tests::OneAgent agent(Scripted::kind(), tests::robot_session());
  agent.now = hal::Time{std::chrono::seconds{3}};
  const Actions actions = agent.control();
  ASSERT_EQ(actions.size(), 3U);
  EXPECT_EQ(std::get<exchange::Record>(actions[0].what),
            (exchange::Record{"distance", -0.25, agent.now}));
  EXPECT_EQ(tests::texts<exchange::Log>(actions),
            (std::vector<std::string>{"r0: record: 'distance' is nan, it must be finite",
                                      "r0: record: name '' has 0 bytes, 1 to 64 are allowed"}));
}

TEST(Record, TakesAsManyNamesAsAnAgentMayUse) {
  const Actions actions = actions_of([](hal::Robot& robot) {
    for (int round = 0; round < 2; ++round) {
      for (std::size_t i = 0; i <= hal::kMaxRecordedNames; ++i) {
        robot.record("value " + std::to_string(i), 1);
      }
    }
  });
  EXPECT_EQ(tests::texts<exchange::Record>(actions).size(), 2 * hal::kMaxRecordedNames);
  EXPECT_EQ(tests::texts<exchange::Log>(actions),
            std::vector<std::string>{"r0: record: 'value 64' would be value 65 of this agent, at "
                                     "most 64 are allowed"});
}

TEST(Object, ActionsKeepTheOrderOfTheCalls) {
  const Actions actions = actions_of([](hal::Robot& robot) {
    robot.set_radio(false);
    robot.log(hal::log::Level::kInfo, "hello");
    robot.state("S");
    EXPECT_TRUE(robot.network().invalidate("help", AgentId{3}).has_value());
  });
  std::vector<exchange::Action::What> what;
  for (const auto& action : actions) what.push_back(action.what);
  EXPECT_EQ(what, (std::vector<exchange::Action::What>{
                      exchange::SetRadio{false}, exchange::Log{hal::log::Level::kInfo, "hello"},
                      exchange::SetState{"S"}, exchange::Invalidate{AgentId{3}, "help"}}));
}

}  // namespace
