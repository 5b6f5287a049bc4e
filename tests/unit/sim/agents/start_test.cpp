#include <gtest/gtest.h>

#include <map>
#include <utility>
#include <vector>

#include "tests/unit/sim/agents/two_motes.h"

namespace {

using namespace tests;

/// Events of one cause, by agent.
std::map<AgentId, std::vector<Time>> times_of(Cause cause, const std::vector<Step>& steps) {
  std::map<AgentId, std::vector<Time>> times;
  for (const Step& step : steps) {
    for (const Event& event : step.events) {
      if (event.cause() == cause) times[event.agent].push_back(event.time);
    }
  }
  return times;
}

Action timer_at(Time at) { return {.what = hal::node::exchange::SetTimer{1, at}}; }

TEST_F(TwoMotes, WithAUniformPhaseAgentsStartWithTheirOwnControlCycleAndTimersDiffer) {
  config.control_phase = sim::agents::ControlPhase::kUniform;
  run(Time{1s}, [](const Event& event) -> std::vector<Action> {
    if (event.cause() == Cause::kStart) return {timer_at(event.time + 200ms)};
    return {};
  });
  const auto starts = times_of(Cause::kStart, port->steps);
  const auto cycles = times_of(Cause::kControl, port->steps);
  const auto timers = times_of(Cause::kTimer, port->steps);
  for (const AgentId agent : {tests::kA, tests::kB}) {
    ASSERT_EQ(starts.at(agent).size(), 1u);
    EXPECT_EQ(starts.at(agent)[0], cycles.at(agent)[0]);
    EXPECT_GT(starts.at(agent)[0], Time{});
    EXPECT_LT(starts.at(agent)[0], Time{config.control_period});
    EXPECT_EQ(timers.at(agent), std::vector{starts.at(agent)[0] + 200ms});
  }
  EXPECT_NE(starts.at(kA), starts.at(kB));
}

TEST_F(TwoMotes, AlignedAgentsStartAtZeroAndTimersMeet) {
  run(Time{1s}, [](const Event& event) -> std::vector<Action> {
    if (event.cause() == Cause::kStart) return {timer_at(event.time + 200ms)};
    return {};
  });
  for (const AgentId agent : {tests::kA, tests::kB}) {
    EXPECT_EQ(times_of(Cause::kStart, port->steps).at(agent), std::vector{Time{}});
    EXPECT_EQ(times_of(Cause::kTimer, port->steps).at(agent), std::vector{Time{200ms}});
  }
}

// The radio is ideal: what the one that starts first sends at once is there before the other
// starts.
TEST_F(TwoMotes, WhatArrivesBeforeTheStartIsHandedOverWithIt) {
  config.control_phase = sim::agents::ControlPhase::kUniform;
  run(Time{1s}, [](const Event& event) -> std::vector<Action> {
    if (event.cause() == Cause::kStart)
      return {tests::send(event.agent == tests::kA ? tests::kB : tests::kA)};
    return {};
  });
  const auto starts = times_of(Cause::kStart, port->steps);
  const AgentId later = starts.at(tests::kA) < starts.at(kB) ? tests::kB : tests::kA;
  std::vector<Cause> causes;
  for (const Step& step : port->steps) {
    for (const Event& event : step.events) {
      if (event.agent != later || event.time > starts.at(later)[0]) continue;
      causes.push_back(event.cause());
      EXPECT_EQ(event.time, starts.at(later)[0]);
    }
  }
  ASSERT_GE(causes.size(), 3u);
  EXPECT_EQ(causes[0], Cause::kStart);
  EXPECT_EQ(causes[1], Cause::kMessage);
  EXPECT_EQ(causes[2], Cause::kControl);
}

TEST_F(TwoMotes, AControllerThatTheRunLeftNoTimeForIsStartedAndStopped) {
  config.control_phase = sim::agents::ControlPhase::kUniform;
  run(Time{}, tests::nothing);
  ASSERT_EQ(port->steps.size(), 1u);
  std::vector<std::pair<AgentId, Cause>> seen;
  for (const Event& event : port->steps[0].events) seen.emplace_back(event.agent, event.cause());
  EXPECT_EQ(seen,
            (std::vector<std::pair<AgentId, Cause>>{
                {kA, Cause::kStart}, {kA, Cause::kStop}, {kB, Cause::kStart}, {kB, Cause::kStop}}));
}

}  // namespace
