#include "hal/node/exchange/courier.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/support/scripted_port.h"

namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;
using hal::node::exchange::Action;
using hal::node::exchange::Cause;
using hal::node::exchange::ControlDue;
using hal::node::exchange::Courier;
using hal::node::exchange::Event;
using hal::node::exchange::MessageArrived;
using hal::node::exchange::Notice;
using hal::node::exchange::Stop;
using tests::ScriptedPort;

const AgentId kA{1}, kB{2};

/// One action per event.
std::vector<Action> answer(const Event&) { return {Action{}}; }

Event event(AgentId agent, Event::What what, hal::Duration at) {
  Event event;
  event.agent = agent;
  event.what = std::move(what);
  event.time = Time{at};
  return event;
}

Event message(AgentId agent, hal::Duration at) { return event(agent, MessageArrived{}, at); }

Event control(AgentId agent, hal::Duration at, double reading) {
  Event control = event(agent, ControlDue{}, at);
  control.readings = {{7, {reading}}};
  return control;
}

class CourierTest : public testing::Test {
 protected:
  CourierTest() { port_->answers = 0; }  // until it is told to

  std::shared_ptr<ScriptedPort> port_ = std::make_shared<ScriptedPort>(answer);
  Courier courier_{port_, 4};
};

TEST_F(CourierTest, HandsOverAtMostOneStepAtATime) {
  courier_.post(message(kA, 1ms));
  EXPECT_TRUE(courier_.attend()->began);
  courier_.post(message(kA, 2ms));
  courier_.post(message(kB, 3ms));
  EXPECT_FALSE(courier_.attend()->began);
  ASSERT_EQ(port_->steps.size(), 1u);
  port_->answers = 1;
  const auto turn = courier_.attend();
  EXPECT_TRUE(turn->replied);
  EXPECT_TRUE(turn->began);
  ASSERT_EQ(port_->steps.size(), 2u);
  EXPECT_EQ(port_->steps[1].sequence, 2u);
  EXPECT_EQ(port_->steps[1].events, (std::vector{message(kA, 2ms), message(kB, 3ms)}));
}

TEST_F(CourierTest, TellsWhichEventAnActionAnswersAndWhoAnswered) {
  courier_.post(message(kB, 1ms));
  courier_.post(message(kA, 2ms));
  courier_.post(message(kB, 2ms));
  ASSERT_TRUE(courier_.attend());
  port_->answers = 1;
  const auto turn = courier_.attend();
  ASSERT_EQ(turn->answers.size(), 3u);
  EXPECT_EQ(turn->answers[0].event_time, Time{1ms});
  EXPECT_EQ(turn->answers[2].event_time, Time{2ms});
  EXPECT_EQ(turn->answered, (std::vector{kA, kB}));
}

TEST_F(CourierTest, AControlCycleTakesThePlaceOfOneThatWaitsAndKeepsItsReadings) {
  courier_.post(message(kA, 0ms));
  ASSERT_TRUE(courier_.attend());
  Event first = control(kA, 100ms, 1.0);
  first.readings.push_back({8, {5.0}});
  courier_.post(first);
  courier_.post(control(kB, 100ms, 9.0));
  courier_.post(control(kA, 200ms, 2.0));
  port_->answers = 1;
  ASSERT_TRUE(courier_.attend());
  ASSERT_EQ(port_->steps[1].events.size(), 2u);
  EXPECT_EQ(port_->steps[1].events[0].agent, kB);
  const Event& merged = port_->steps[1].events[1];
  EXPECT_EQ(merged.time, Time{200ms});
  EXPECT_EQ(merged.readings, (std::vector<hal::node::exchange::Reading>{{7, {2.0}}, {8, {5.0}}}));
  EXPECT_EQ(courier_.losses().missed_cycles, 1u);
}

TEST_F(CourierTest, ASupersededCyclesChangesReachTheNextEventOfItsAgentInOrder) {
  courier_.post(message(kA, 0ms));
  ASSERT_TRUE(courier_.attend());
  Event cycle = control(kA, 100ms, 1.0);
  cycle.routes = {{{"help", kB, kB, {}}, false}};
  courier_.post(cycle);
  Event between = message(kA, 150ms);
  between.routes = {{{"help", kB, kA, {}}, true}};
  courier_.post(between);
  courier_.post(control(kA, 200ms, 2.0));
  port_->answers = 1;
  ASSERT_TRUE(courier_.attend());
  const Event& first = port_->steps[1].events[0];
  EXPECT_EQ(first.cause(), Cause::kMessage);
  EXPECT_EQ(first.readings, (std::vector<hal::node::exchange::Reading>{{7, {1.0}}}));
  ASSERT_EQ(first.routes.size(), 2u);
  EXPECT_FALSE(first.routes[0].removed);
  EXPECT_TRUE(first.routes[1].removed);
}

TEST_F(CourierTest, OverflowIsCountedByAgentAndCauseAndKeepsStartAndStop) {
  courier_.post(message(kA, 0ms));
  ASSERT_TRUE(courier_.attend());
  for (int i = 1; i <= 4; ++i) courier_.post(message(kA, i * 1ms));
  Event lost = message(kB, 5ms);
  lost.readings = {{3, {1.5}}};
  courier_.post(lost);
  courier_.post(message(kB, 6ms));
  courier_.post(event(kB, Notice{}, 6ms));
  courier_.post(event(kB, Stop{}, 7ms));
  const auto& overflow = courier_.losses().overflow;
  EXPECT_EQ(overflow.size(), 2u);
  EXPECT_EQ(overflow.at({kB, Cause::kMessage}), 2u);
  EXPECT_EQ(overflow.at({kB, Cause::kNotice}), 1u);
  port_->answers = 1;
  ASSERT_TRUE(courier_.attend());
  ASSERT_EQ(port_->steps[1].events.size(), 5u);
  EXPECT_EQ(port_->steps[1].events[4].cause(), Cause::kStop);
  EXPECT_EQ(port_->steps[1].events[4].readings, lost.readings);
}

TEST_F(CourierTest, DeathIsAnErrorWhetherAStepIsUnderWayOrNot) {
  port_->dead = true;
  EXPECT_EQ(courier_.attend().error().code, hal::Errc::kNotConnected);
  port_->dead = false;
  courier_.post(message(kA, 0ms));
  ASSERT_TRUE(courier_.attend());
  port_->dead = true;
  EXPECT_EQ(courier_.attend().error().code, hal::Errc::kNotConnected);
}

TEST_F(CourierTest, ARecordedOutcomeIsRepeatedWhateverThePortWouldDo) {
  courier_.post(message(kA, 0ms));
  EXPECT_TRUE(courier_.repeat(false, true)->began);
  courier_.post(message(kA, 1ms));
  EXPECT_FALSE(courier_.repeat(false, false)->replied);
  const auto turn = courier_.repeat(true, false);
  EXPECT_TRUE(turn->replied);
  EXPECT_FALSE(turn->began);
  EXPECT_TRUE(courier_.is_idle());
  EXPECT_TRUE(courier_.has_waiting());
}

TEST_F(CourierTest, ARecordThatDoesNotFitIsRefused) {
  EXPECT_EQ(courier_.repeat(true, false).error().code, hal::Errc::kProtocol);
  EXPECT_EQ(courier_.repeat(false, true).error().code, hal::Errc::kProtocol);
  courier_.post(message(kA, 0ms));
  ASSERT_TRUE(courier_.repeat(false, true));
  courier_.post(message(kA, 1ms));
  EXPECT_EQ(courier_.repeat(false, true).error().code, hal::Errc::kProtocol);
}

TEST(Absorb, ANeighbourLostThenHeardIsHeardAndOneHeardThenLostIsLost) {
  Event earlier, later;
  earlier.neighbours = {{AgentId{1}, Time{1s}, -50}, {AgentId{2}, Time{1s}, -60}};
  earlier.lost_neighbours = {AgentId{3}, AgentId{4}};
  later.neighbours = {{AgentId{3}, Time{2s}, -70}};
  later.lost_neighbours = {AgentId{2}};
  absorb(earlier, later);
  EXPECT_EQ(later.neighbours, (std::vector<hal::Neighbour>{{AgentId{3}, Time{2s}, -70},
                                                           {AgentId{1}, Time{1s}, -50}}));
  EXPECT_EQ(later.lost_neighbours, (std::vector{AgentId{2}, AgentId{4}}));
}

TEST(Absorb, OfARouteTheLastWordIsKeptHoweverLongItTakes) {
  const auto route = [](std::uint16_t destination, std::uint16_t next_hop, std::uint16_t hops) {
    hal::RouteChange change;
    change.route = {"help", AgentId{destination}, AgentId{next_hop}, {.hops = hops}};
    return change;
  };
  Event all;
  for (std::uint16_t hops = 1; hops <= 1000; ++hops) {
    Event later;
    later.routes = {route(1, 2, hops), route(1, 3, hops), route(4, 2, hops)};
    later.routes[1].removed = hops % 2 == 0;
    absorb(std::exchange(all, {}), later);
    all = std::move(later);
  }
  ASSERT_EQ(all.routes.size(), 3u);
  EXPECT_EQ(all.routes[0], route(1, 2, 1000));
  EXPECT_TRUE(all.routes[1].removed);
  EXPECT_EQ(all.routes[2], route(4, 2, 1000));
}

}  // namespace
