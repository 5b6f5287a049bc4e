#include "gateway/server/admission.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/gateway/server/offers.h"

namespace gateway::server {
namespace {

using hal::node::exchange::Hello;
using hal::node::exchange::Session;

std::vector<std::string> names_in(const Session& session) {
  std::vector<std::string> names;
  for (const auto& agent : session.agents) names.push_back(agent.name);
  return names;
}

Hello robot_hello() {
  Hello hello = hello_for("driver", {"r0"});
  hello.program = "help_robot";
  hello.kind = hal::AgentKind::kRobot;
  hello.wants.channels = {"infrared"};
  return hello;
}

TEST(Admission, GrantsEveryAgentAPatternFitsByAddress) {
  Admission admission(sample_offers(), 5);
  const Session session = admission.decide(hello_for("p", {"m3", "m[", "m*"}));
  EXPECT_EQ(session.refusal, "unknown agent 'm['");  // No brackets as in a shell.
  const Session granted = admission.decide(hello_for("q", {"m3", "m*"}));
  EXPECT_EQ(granted.refusal, "");
  EXPECT_EQ(granted.run, 5);
  EXPECT_EQ(granted.instance, "q/1");
  EXPECT_EQ(names_in(granted), (std::vector<std::string>{"m1", "m2", "m3"}));
}

TEST(Admission, OfOneOfSeveralServersNeedsOnlyOnePatternToFit) {
  Admission admission(sample_offers(), 1, Admission::Offered::kSome);
  EXPECT_TRUE(admission.is_for_others(hello_for("p", {"x1", "x2"})));
  EXPECT_FALSE(admission.is_for_others(hello_for("q", {"x1", "m2"})));
  EXPECT_EQ(names_in(admission.decide(hello_for("q", {"x1", "m2"}))),
            (std::vector<std::string>{"m2"}));
}

TEST(Admission, OfTheOnlyServerLeavesNobodyToOthers) {
  EXPECT_FALSE(Admission(sample_offers(), 1).is_for_others(hello_for("p", {"x1"})));
}

TEST(Admission, IsCompleteWhenEveryAgentHasAController) {
  Admission admission(sample_offers(), 1);
  EXPECT_EQ(admission.decide(hello_for("p", {"m1", "m3"})).refusal, "");
  EXPECT_EQ(admission.missing(), (std::vector<std::string>{"m2 (help_mote)", "r0"}));
  EXPECT_FALSE(admission.is_complete());
  EXPECT_EQ(admission.decide(robot_hello()).refusal, "");
  EXPECT_EQ(admission.decide(hello_for("q", {"m2"})).refusal, "");
  EXPECT_TRUE(admission.is_complete());
}

TEST(Admission, GrantsOnlyTheChannelsThatWereAskedFor) {
  Admission admission(sample_offers(), 1);
  const Session session = admission.decide(robot_hello());
  ASSERT_EQ(session.agents.at(0).channels.size(), 1);
  EXPECT_EQ(session.agents[0].channels[0].name, "infrared");
}

TEST(Admission, RefusesWithTheReason) {
  Admission admission(sample_offers(), 1);
  ASSERT_EQ(admission.decide(hello_for("first", {"m1"})).refusal, "");

  Hello version = hello_for("p", {"m2"});
  version.version = 9;
  EXPECT_EQ(admission.decide(version).refusal,
            "protocol version 9; this server speaks " +
                std::to_string(hal::node::exchange::kProtocolVersion));
  EXPECT_EQ(admission.decide(hello_for("p", {})).refusal, "it asks for no agent");
  EXPECT_EQ(admission.decide(hello_for("p", {"m2", "x*"})).refusal, "unknown agent 'x*'");
  EXPECT_EQ(admission.decide(hello_for("p", {"m*"})).refusal,
            "agent 'm1' is taken by process 'first'");
  Hello program = hello_for("p", {"m2"});
  program.program = "other";
  EXPECT_EQ(admission.decide(program).refusal,
            "agent 'm2' is for program 'help_mote', not 'other'");
  EXPECT_EQ(admission.decide(hello_for("p", {"r0"})).refusal,
            "agent 'r0' is a robot; 'help_mote' drives a mote");
  Hello channel = robot_hello();
  channel.wants.channels = {"camera"};
  EXPECT_EQ(admission.decide(channel).refusal,
            "r0 has no channel 'camera'; it has: infrared, odometry");
  Hello same_name = hello_for("first", {"m2"});
  same_name.instance = "first/2";
  EXPECT_EQ(admission.decide(same_name).refusal, "another process is called 'first'");
  Hello nameless = hello_for("", {"m2"});
  EXPECT_EQ(admission.decide(nameless).refusal, "the process has no name");
}

TEST(Admission, RefusedHelloTakesNothing) {
  Admission admission(sample_offers(), 1);
  ASSERT_NE(admission.decide(hello_for("p", {"m1", "r0"})).refusal, "");
  EXPECT_EQ(admission.decide(hello_for("q", {"m1"})).refusal, "");
}

TEST(Admission, RepeatedHelloGetsItsSessionAgain) {
  Admission admission(sample_offers(), 1);
  const Session first = admission.decide(hello_for("p", {"m1"}));
  admission.close();
  EXPECT_EQ(admission.decide(hello_for("p", {"m1"})), first);
}

TEST(Admission, ReleasedAgentsAreFreeAgain) {
  Admission admission(sample_offers(), 1);
  ASSERT_EQ(admission.decide(hello_for("p", {"m1"})).refusal, "");
  admission.release("p/1");
  EXPECT_EQ(admission.decide(hello_for("q", {"m1"})).refusal, "");
}

TEST(Admission, NobodyJoinsOnceClosed) {
  Admission admission(sample_offers(), 1);
  admission.close();
  EXPECT_EQ(admission.decide(hello_for("p", {"m1"})).refusal,
            "the run has begun; no process can join it");
}

TEST(Admission, ProgramOfBothKindsDrivesEither) {
  Admission admission(sample_offers(), 1);
  Hello both = hello_for("p", {"r0"});
  both.both_kinds = true;
  EXPECT_EQ(admission.decide(both).refusal, "");
}

}  // namespace
}  // namespace gateway::server
