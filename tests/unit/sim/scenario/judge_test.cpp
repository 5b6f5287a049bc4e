#include "sim/scenario/judge.h"

#include <gtest/gtest.h>

namespace sim::scenario {
namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;
using Lines = std::vector<std::string>;

constexpr AgentId kMote{1}, kRobot{2}, kOther{3};

agents::AgentConfig agent(AgentId id, const std::string& name) {
  agents::AgentConfig made;
  made.id = id;
  made.name = name;
  return made;
}

/// r0 must end below 10 m from m0, with the result "arrived".
Scenario scenario() {
  Scenario made;
  made.simulation.agents = {agent(kMote, "m0"), agent(kRobot, "r0"), agent(kOther, "r1")};
  made.expectations = {
      {ExpectedResult{"arrived"}, "a.yaml:1:1"},
      {ExpectedDistance{.whose = "r0", .which = {kRobot}, .to = kMote, .below = hal::Metres{10}},
       "a.yaml:2:1"}};
  return made;
}

/// Whichever robot was the last to enter ARRIVED must end below 10 m from m0.
Scenario whichever_arrived() {
  Scenario made = scenario();
  made.expectations = {{ExpectedDistance{.whose = "r*",
                                         .which = {kRobot, kOther},
                                         .to = kMote,
                                         .below = hal::Metres{10},
                                         .entered = "ARRIVED"},
                        "a.yaml:3:1"}};
  return made;
}

/// The mote at (100, 50) m, the robots so many metres from it along (0.6, 0.8).
TruePosition robots_at(double distance, double other) {
  return [=](AgentId id) {
    const hal::Vec2 mote{100, 50};
    if (id == kMote) return mote;
    return mote + (id == kRobot ? distance : other) * hal::Vec2{0.6, 0.8};
  };
}

TEST(Expectations, AreSilentWhenTheyHold) {
  const Scenario one = scenario();
  EXPECT_EQ(Judge(one).unmet("arrived", robots_at(9.99, 500)), Lines{});
}

TEST(Expectations, SayWhatWasSeenAndExpected) {
  const Scenario one = scenario();
  EXPECT_EQ(Judge(one).unmet("timeout", robots_at(25, 5)),
            (Lines{"a.yaml:1:1: expect: the result is 'timeout', expected 'arrived'",
                   "a.yaml:2:1: expect: r0 is 25.000 m from m0, expected below 10 m"}));
}

TEST(Expectations, TakeTheLimitItselfAsTooFar) {
  const Scenario one = scenario();
  EXPECT_EQ(Judge(one).unmet("arrived", robots_at(10, 5)).size(), 1u);
}

TEST(Expectations, AreAboutTheLastAgentOfAPatternToEnterAState) {
  const Scenario whichever = whichever_arrived();
  Judge judge(whichever);
  judge.on_state(Time{1s}, kRobot, "ARRIVED");
  judge.on_state(Time{1s}, kRobot, "IDLE");
  EXPECT_EQ(judge.unmet("arrived", robots_at(5, 500)), Lines{});
  judge.on_state(Time{2s}, kOther, "ARRIVED");
  judge.on_state(Time{3s}, kRobot, "IDLE");
  judge.on_state(Time{3s}, kMote, "ARRIVED");
  EXPECT_EQ(judge.unmet("arrived", robots_at(5, 500)),
            Lines{"a.yaml:3:1: expect: r1 is 500.000 m from m0, expected below 10 m"});
  EXPECT_EQ(judge.unmet("arrived", robots_at(500, 5)), Lines{});
}

TEST(Expectations, FailIfNobodyEnteredTheState) {
  const Scenario whichever = whichever_arrived();
  EXPECT_EQ(Judge(whichever).unmet("arrived", robots_at(5, 5)),
            Lines{"a.yaml:3:1: expect: no agent of 'r*' has entered ARRIVED, expected below 10 m "
                  "from m0"});
}

}  // namespace
}  // namespace sim::scenario
