#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "tests/unit/sim/agents/two_motes.h"

namespace {

using namespace tests;

TEST_F(TwoMotes, BodyThatIsLostIsAVerdictOfTheRun) {
  EXPECT_TRUE(run(Time{1s}, nothing).bodies_lost.empty());
  config.agents[1].pose.x = 100'001;  // farther away than any robot drives
  const Outcome outcome = run(Time{1s}, tests::nothing);
  EXPECT_EQ(outcome.bodies_lost,
            (std::vector<std::string>{"b lost: it is farther than 100 km away at 0.010000000 s"}));
  EXPECT_EQ(effects.lost, std::vector<AgentId>{kB});
}

TEST_F(TwoMotes, TopicsBeyondTheLimitOfAnAgentAreRefusedWhateverItsProcessSays) {
  std::uint32_t messages = 0;
  const Outcome outcome = run(Time{450ms}, [&](const Event& event) {
    std::vector<Action> actions;
    if (event.agent != tests::kA || event.cause() != Cause::kControl) return actions;
    for (int i = 0; i < 100; ++i) {
      const std::string topic = "topic " + std::to_string(++messages);
      actions.push_back({.what = Send{messages, tests::kB, topic, {}}});
    }
    return actions;
  });
  ASSERT_EQ(messages, 500u);
  EXPECT_EQ(outcome.refused_actions, 500u - hal::kMaxTopics);
}

TEST_F(TwoMotes, StartAndTheFirstControlCycleAreOneExchangeByAgentThenCause) {
  run(Time{50ms}, tests::nothing);
  ASSERT_EQ(port->steps.size(), 2u) << "time 0, and the stop";
  std::vector<std::pair<AgentId, Cause>> seen;
  for (const Event& event : port->steps[0].events) seen.emplace_back(event.agent, event.cause());
  EXPECT_EQ(
      seen,
      (std::vector<std::pair<AgentId, Cause>>{
          {kA, Cause::kStart}, {kA, Cause::kControl}, {kB, Cause::kStart}, {kB, Cause::kControl}}));
  EXPECT_EQ(port->steps[1].events.front().cause(), Cause::kStop);
  EXPECT_EQ(port->steps[1].events.front().time, Time{50ms});
}

// 0, 100, …, 500 ms, and the stop.
TEST_F(TwoMotes, AlignedControlCyclesAreOneExchangeEach) {
  EXPECT_EQ(run(Time{500ms}, nothing).exchanges, 7u);
}

TEST_F(TwoMotes, AMessageSentAtAnInstantArrivesInALaterRoundOfThatInstant) {
  run(Time{2s}, [](const Event& event) -> std::vector<Action> {
    if (event.agent == tests::kA && event.cause() == Cause::kControl && event.time == Time{1s}) {
      return {tests::send(tests::kB)};
    }
    return {};
  });
  int deliveries = 0;
  for (const Step& step : port->steps) {
    for (const Event& event : step.events) {
      if (event.cause() != Cause::kMessage) continue;
      ++deliveries;
      EXPECT_EQ(event.time, Time{1s}) << "the ideal radio takes no time";
      // A round of its own, after the control cycle that sent it; the sender is told as well.
      ASSERT_EQ(step.events.size(), 2u);
      EXPECT_EQ(step.events[0].cause(), Cause::kNotice);
    }
  }
  EXPECT_EQ(deliveries, 1);
}

/// What the controllers heard of neighbours and of their own messages.
struct Heard {
  std::vector<double> rssi_dbm;
  std::vector<hal::Fate> fates;
  int messages = 0;
  Time first_link = Time::max();
};

Heard heard(const std::vector<Step>& steps) {
  Heard result;
  for (const Step& step : steps) {
    for (const Event& event : step.events) {
      for (const hal::Neighbour& n : event.neighbours) result.rssi_dbm.push_back(n.rssi_dbm);
      if (event.cause() == Cause::kNotice) {
        result.fates.push_back(std::get<hal::node::exchange::Notice>(event.what).fate);
      }
      result.messages += event.cause() == Cause::kMessage;
      if (event.cause() == Cause::kLink)
        result.first_link = std::min(result.first_link, event.time);
    }
  }
  return result;
}

// The same air with and without the MAC's reports. Both find each other, and the message arrives
// and is acknowledged, but without them power is unknown and hellos alone introduce neighbours.
TEST_F(TwoMotes, AUdpLikeLinkHidesWhatTheMacKnowsAndMessagesArriveAllTheSame) {
  config.radio = sim::radio::profile_defaults(sim::radio::Profile::kMobilityFramework);
  for (const auto link : {sim::agents::LinkKind::kMac, sim::agents::LinkKind::kUdpLike}) {
    config.link = link;
    const bool is_mac = link == sim::agents::LinkKind::kMac;
    run(Time{4s},
        [](const Event& event) -> std::vector<Action> {
          const bool is_time = event.cause() == Cause::kControl && event.time == Time{3s};
          return event.agent == tests::kA && is_time ? std::vector{tests::send(tests::kB)}
                                                     : std::vector<Action>{};
        },
        {.neighbours = true});
    const Heard result = heard(port->steps);
    EXPECT_EQ(result.messages, 1);
    EXPECT_EQ(result.fates, std::vector{hal::Fate::kHandedOver});
    ASSERT_FALSE(result.rssi_dbm.empty());
    for (const double rssi : result.rssi_dbm) {
      if (is_mac) {
        EXPECT_LT(rssi, -20);  // 10 m
      } else {
        EXPECT_EQ(rssi, 0.0);
      }
    }
    EXPECT_EQ(result.first_link < Time{3s}, !is_mac) << "before anybody sends a message";
  }
}

TEST_F(TwoMotes, WithALatencyActionsTakeEffectThatMuchLater) {
  config.controller_latency = 10ms;
  run(Time{300ms}, [](const Event& event) -> std::vector<Action> {
    return event.cause() == Cause::kControl ? std::vector{tests::state("x")}
                                            : std::vector<Action>{};
  });
  ASSERT_GE(effects.actions.size(), 4u);
  EXPECT_EQ(effects.actions[0].first, Time{10ms});
  EXPECT_EQ(effects.actions[2].first, Time{110ms});
}

// Phases 10 ms apart or more are exchanges of their own without latency; a window holds them all.
TEST_F(TwoMotes, AWindowOfLatencyIsOneExchange) {
  config.control_phase = sim::agents::ControlPhase::kUniform;
  const auto without = run(Time{10s}, tests::nothing).exchanges;
  config.controller_latency = 100ms;
  const auto with = run(Time{10s}, tests::nothing).exchanges;
  EXPECT_GE(without, 200u);
  EXPECT_LE(with, 102u);
  for (const Step& step : port->steps) {
    EXPECT_LE(step.events.back().time - step.events.front().time, 100ms);
    for (const Event& event : step.events) EXPECT_LE(event.time, step.until);
  }
}

TEST_F(TwoMotes, EndsTheGivenTimeAfterAState) {
  config.ends = {{.agent = tests::kB, .state = "DONE", .after = 250ms, .result = "done"},
                 {.agent = {}, .state = {}, .after = 5s, .result = "timeout"}};
  const auto rule = [](AgentId who) {
    return [who](const Event& event) -> std::vector<Action> {
      return event.agent == who && event.time == Time{1s} ? std::vector{tests::state("DONE")}
                                                          : std::vector<Action>{};
    };
  };
  const Outcome done = run(Time{10s}, rule(tests::kB));
  EXPECT_EQ(done.result, "done");
  EXPECT_EQ(done.ended_at, Time{1250ms});
  const Outcome timeout = run(Time{10s}, rule(tests::kA));
  EXPECT_EQ(timeout.result, "timeout");
  EXPECT_EQ(timeout.ended_at, Time{5s});
}

TEST_F(TwoMotes, ActionsBeyondTheRulesAreRefusedCountedAndTheRunGoesOn) {
  const Outcome outcome = run(Time{1s}, [](const Event& event) -> std::vector<Action> {
    if (event.cause() != Cause::kStart || event.agent != tests::kA) return {};
    const Send nameless{1, tests::kB, "", {}};
    return {tests::drive(0),
            tests::send(tests::kA),
            {.what = nameless},
            tests::send(tests::kB, 1, hal::Bytes(hal::kMaxPayload + 1))};
  });
  EXPECT_EQ(outcome.refused_actions, 4u);
  EXPECT_EQ(outcome.kind, Outcome::Kind::kUntil);
}

TEST_F(TwoMotes, AControllerThatThrowsEndsTheRunAndIsNamed) {
  const Outcome outcome = run(Time{1s}, [](const Event& event) -> std::vector<Action> {
    const Action error{.what = hal::node::exchange::ControllerFailed{"no more"}};
    return event.agent == tests::kB && event.time == Time{300ms} ? std::vector{error}
                                                                 : std::vector<Action>{};
  });
  EXPECT_EQ(outcome.kind, Outcome::Kind::kFailed);
  EXPECT_EQ(outcome.error, "the controller of b (process script) failed at 0.300000000 s: no more");
}

TEST_F(TwoMotes, TimersCallBackOnceAndMayBeMoved) {
  run(Time{2s}, [](const Event& event) -> std::vector<Action> {
    if (event.agent != tests::kA || event.cause() != Cause::kStart) return {};
    using hal::node::exchange::SetTimer;
    return {{.what = SetTimer{7, Time{500ms}}}, {.what = SetTimer{7, Time{1500ms}}}};
  });
  std::vector<Time> called;
  for (const Step& step : port->steps) {
    for (const Event& event : step.events) {
      if (event.cause() == Cause::kTimer) called.push_back(event.time);
    }
  }
  EXPECT_EQ(called, std::vector<Time>{Time{1500ms}});
}

}  // namespace
