#include "sim/scenario/judge.h"

#include <gtest/gtest.h>

namespace sim::scenario {
namespace {

using Lines = std::vector<std::string>;

/// r0 (address 2) must end below 10 m from m0 (address 1), with the result "arrived".
Scenario scenario() {
  Scenario made;
  agents::AgentConfig mote;
  mote.id = hal::AgentId{1};
  mote.name = "m0";
  agents::AgentConfig robot;
  robot.id = hal::AgentId{2};
  robot.name = "r0";
  made.simulation.agents = {mote, robot};
  made.expectations = {{ExpectedResult{"arrived"}, "a.yaml:1:1"},
                       {ExpectedDistance{robot.id, mote.id, hal::Metres{10}}, "a.yaml:2:1"}};
  return made;
}

/// The mote at (100, 50) m, the robot so many metres from it along (0.6, 0.8).
TruePosition robot_at(double distance) {
  return [distance](hal::AgentId id) {
    const hal::Vec2 mote{100, 50};
    return id.value == 1 ? mote : mote + distance * hal::Vec2{0.6, 0.8};
  };
}

TEST(Expectations, AreSilentWhenTheyHold) {
  EXPECT_EQ(unmet_expectations(scenario(), "arrived", robot_at(9.99)), Lines{});
}

TEST(Expectations, SayWhatWasSeenAndExpected) {
  EXPECT_EQ(unmet_expectations(scenario(), "timeout", robot_at(25)),
            (Lines{"a.yaml:1:1: expect: the result is 'timeout', expected 'arrived'",
                   "a.yaml:2:1: expect: r0 is 25.000 m from m0, expected below 10 m"}));
}

TEST(Expectations, TakeTheLimitItselfAsTooFar) {
  EXPECT_EQ(unmet_expectations(scenario(), "arrived", robot_at(10)).size(), 1u);
}

}  // namespace
}  // namespace sim::scenario
