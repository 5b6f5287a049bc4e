// What the events of a scenario do to the agents of a run.
#include <algorithm>
#include <memory>
#include <optional>

#include "sim/agents/quantities.h"
#include "sim/agents/scripted_event.h"
#include "tests/support/slope.h"
#include "tests/unit/sim/agents/two_motes.h"
#include "tests/unit/sim/physics/robertino.h"

namespace tests {
namespace {

using sim::agents::AtTime;
using sim::agents::Befall;
using sim::agents::Fortune;
using sim::agents::ScriptedAction;
using sim::agents::ScriptedDone;
using sim::agents::ScriptedEvent;

ScriptedAction befall(Fortune fortune, AgentId agent) {
  return {Befall{fortune}, "x", {agent}, {}};
}

/// When actions of the script were done.
class Done final : public sim::agents::Observer {
 public:
  void on_scripted(const ScriptedDone& done) override { times.push_back(done.at); }
  std::vector<Time> times;
};

/// Of the second agent: where it is at its control instants, and when it was displaced.
class Whereabouts final : public sim::agents::Observer {
 public:
  void on_body(Time at, AgentId agent, const sim::agents::BodyState& body) override {
    if (agent == kB) track.emplace_back(at, body.x);
  }
  void on_displaced(Time at, AgentId agent) override {
    if (agent == kB) displaced.push_back(at);
  }
  std::vector<std::pair<Time, double>> track;  ///< m
  std::vector<Time> displaced;
};

class Scripted : public TwoMotes {
 protected:
  Scripted() {
    for (auto& agent : config.agents) agent.program = "script";
  }
  /// With this radio, and no search for routes.
  void hop_over(sim::radio::Profile profile) {
    config.radio = sim::radio::profile_defaults(profile);
    for (auto& agent : config.agents) agent.routing = hal::node::routing::Algorithm::kNone;
  }
  void at(hal::Duration when, ScriptedAction action) {
    config.script.push_back({AtTime{when}, {std::move(action)}, {}});
  }
  /// A run with controllers of this rule, observed by `done_`, ready to run.
  void begin_simulation(ScriptedPort::Rule rule = nothing) {
    port = std::make_shared<ScriptedPort>(std::move(rule));
    simulation_ = std::make_unique<sim::agents::Simulation>(
        config, std::vector<sim::agents::Observer*>{&done_, &whereabouts});
    simulation_->connect(port, {kA, kB}, {});
  }
  Outcome run(Time until, ScriptedPort::Rule rule) {
    port = std::make_shared<ScriptedPort>(std::move(rule));
    sim::agents::Simulation one(config, {&effects, &whereabouts});
    one.connect(port, {kA, kB}, {});
    return one.run(until, pace_);
  }
  void give_batteries() {
    hal::node::devices::Battery battery;
    battery.capacity = 1000;
    battery.full_voltage = battery.empty_voltage = 10;
    battery.idle_power = 10;
    battery.radio = {.transmit = 1, .receive = 1, .listen = 0.8, .off = 0.5};
    for (auto& agent : config.agents)
      std::get<hal::node::devices::MoteDescription>(agent.body).sensors.emplace_back(battery);
  }
  double x_at(hal::Duration when) const {
    for (const auto& [time, x] : whereabouts.track)
      if (time >= Time{when}) return x;
    return 0;
  }
  /// Each mote sends to the other one in each control cycle.
  Outcome run_sending(Time until) {
    return run(until, [](const Event& event) -> std::vector<Action> {
      if (event.cause() != Cause::kControl) return {};
      return {send(event.agent == kA ? kB : kA)};
    });
  }
  /// Events of a cause that an agent's controllers were handed in [from, to).
  std::size_t handed(AgentId agent, Cause cause, Time from, Time to) const {
    const auto seen = port->of(cause);
    return static_cast<std::size_t>(std::ranges::count_if(seen, [&](const Event& event) {
      return event.agent == agent && event.time >= from && event.time < to;
    }));
  }

  Done done_;
  Whereabouts whereabouts;
  NoPace pace_;
  std::unique_ptr<sim::agents::Simulation> simulation_;
};

TEST_F(Scripted, AKilledControllerIsToldNothingButTheEndAndItsRadioLivesOn) {
  at(1s, befall(Fortune::kKill, kB));
  run_sending(Time{2s});
  EXPECT_EQ(handed(kB, Cause::kControl, Time{}, Time{1s}), 10u);
  EXPECT_EQ(handed(kB, Cause::kControl, Time{1s}, Time{3s}), 0u);
  EXPECT_EQ(handed(kB, Cause::kMessage, Time{1s}, Time{3s}), 0u);
  EXPECT_EQ(handed(kB, Cause::kStop, Time{1s}, Time{3s}), 1u);
  // Its radio still acknowledges: the other one's messages are handed over.
  const auto notices = port->of(Cause::kNotice);
  ASSERT_FALSE(notices.empty());
  EXPECT_EQ(notices.back().agent, kA);
  EXPECT_EQ(std::get<hal::node::exchange::Notice>(notices.back().what).fate,
            hal::Fate::kHandedOver);
}

TEST_F(Scripted, ARestartedControllerBeginsWithItsStart) {
  at(1s, befall(Fortune::kKill, kB));
  at(1550ms, befall(Fortune::kRestart, kB));
  run_sending(Time{2s});
  EXPECT_EQ(handed(kB, Cause::kStart, Time{}, Time{1s}), 1u);
  EXPECT_EQ(handed(kB, Cause::kStart, Time{1550ms}, Time{1551ms}), 1u);
  EXPECT_EQ(handed(kB, Cause::kControl, Time{1s}, Time{1550ms}), 0u);
  EXPECT_GE(handed(kB, Cause::kControl, Time{1550ms}, Time{2s}), 4u);
  EXPECT_EQ(handed(kA, Cause::kStart, Time{}, Time{3s}), 1u);
}

TEST_F(Scripted, WhatAKilledControllerHadDecidedDiesWithIt) {
  config.controller_latency = 150ms;
  at(1s, befall(Fortune::kKill, kB));
  at(1s, befall(Fortune::kRestart, kB));
  run_sending(Time{1150ms});
  // Of A the answers to the cycles from 0 to 1 s took effect; of B those from 0 to 0.8 s, and that
  // of its successor to the one of 1 s, but not the one of 0.9 s, which was under way.
  const auto is_send = [](const auto& effect) {
    return std::holds_alternative<Send>(effect.second);
  };
  EXPECT_EQ(std::ranges::count_if(effects.actions, is_send), 10 + 11);
}

TEST_F(Scripted, WithoutPowerNothingIsSentOrReceived) {
  at(1s, befall(Fortune::kSwitchOff, kB));
  at(1500ms, befall(Fortune::kSwitchOn, kB));
  run_sending(Time{2s});
  EXPECT_EQ(handed(kA, Cause::kMessage, Time{1s}, Time{1500ms}), 0u);
  EXPECT_EQ(handed(kB, Cause::kControl, Time{1s}, Time{1500ms}), 5u);  // it does not know
  EXPECT_GT(handed(kA, Cause::kMessage, Time{1500ms}, Time{2s}), 0u);
}

TEST_F(Scripted, AnAgentThatIsNotPresentTakesNoPartUntilItIsAdded) {
  config.agents[1].is_present = false;
  at(1s, befall(Fortune::kAdd, kB));
  at(1500ms, befall(Fortune::kRemove, kB));
  run_sending(Time{2s});
  EXPECT_EQ(handed(kA, Cause::kMessage, Time{}, Time{1s}), 0u);
  EXPECT_GT(handed(kA, Cause::kMessage, Time{1s}, Time{1500ms}), 0u);
  EXPECT_EQ(handed(kA, Cause::kMessage, Time{1600ms}, Time{2s}), 0u);
  EXPECT_EQ(handed(kB, Cause::kStart, Time{}, Time{1s}), 0u);
  EXPECT_EQ(handed(kB, Cause::kStart, Time{1s}, Time{3s}), 1u);
  EXPECT_EQ(handed(kB, Cause::kControl, Time{1500ms}, Time{3s}), 0u);
}

TEST_F(Scripted, ARestartedControllerFindsItsWheelsAtRest) {
  auto robot = sim::physics::test::robertino(hal::node::devices::WheelLevel::kContact);
  robot.infrared.clear();
  config.agents[1].body = robot;
  at(1s, befall(Fortune::kRestart, kB));
  run(Time{4s}, [](const Event& event) -> std::vector<Action> {
    if (event.agent != kB || event.cause() != Cause::kStart || event.time > Time{}) return {};
    return {tests::drive(0.3)};
  });
  EXPECT_NEAR(x_at(1s) - x_at(0s), 0.3, 0.1);
  EXPECT_NEAR(whereabouts.track.back().second, x_at(1500ms), 1e-3);
}

TEST_F(Scripted, TheEndItselfCounts) {
  sim::agents::Condition at_last;
  at_last.what = sim::agents::TimeReached{1s};
  config.asked = {at_last};
  config.ends = {{.agent = {}, .state = {}, .after = 1s, .result = "done", .when = {}}};
  begin_simulation();
  EXPECT_EQ(simulation_->run(Time{5s}, pace_).result, "done");
  EXPECT_TRUE(simulation_->holds(0));
  EXPECT_TRUE(simulation_->has_held(0));
}

TEST_F(Scripted, NothingButAddHasAnEffectOnAnAgentThatIsNotPresent) {
  give_batteries();
  at(1s, befall(Fortune::kRemove, kB));
  at(1100ms, {sim::agents::MoveTo{{15, 0, 0}}, "b", {kB}, {}});
  at(1200ms, {sim::agents::Drain{.energy = {}, .level = 0.5}, "b", {kB}, {}});
  at(1300ms, befall(Fortune::kRestart, kB));
  at(1400ms, befall(Fortune::kRemove, kB));
  begin_simulation();
  simulation_->run(Time{2s}, pace_);
  EXPECT_EQ(done_.times, std::vector{Time{1s}});
  EXPECT_GT(simulation_->body(kB).x, 1e4);
}

TEST_F(Scripted, AnAgentThatIsAddedComesSwitchedOn) {
  at(1s, befall(Fortune::kSwitchOff, kB));
  at(1100ms, befall(Fortune::kRemove, kB));
  at(1500ms, befall(Fortune::kAdd, kB));
  run_sending(Time{2s});
  EXPECT_EQ(handed(kA, Cause::kMessage, Time{1s}, Time{1500ms}), 0u);
  EXPECT_GT(handed(kA, Cause::kMessage, Time{1500ms}, Time{2s}), 0u);
}

TEST_F(Scripted, ARestartedControllerFindsItsRadioOn) {
  at(1s, befall(Fortune::kRestart, kB));
  run(Time{2s}, [](const Event& event) -> std::vector<Action> {
    if (event.cause() != Cause::kControl) return {};
    std::vector<Action> actions{send(event.agent == kA ? kB : kA)};
    if (event.agent == kB && event.time == Time{500ms}) {
      actions.push_back({.what = hal::node::exchange::SetRadio{false}});
    }
    return actions;
  });
  EXPECT_EQ(handed(kA, Cause::kMessage, Time{600ms}, Time{1s}), 0u);
  EXPECT_GT(handed(kA, Cause::kMessage, Time{1s}, Time{2s}), 0u);
}

TEST_F(Scripted, OfWhatIsNotPresentNoConditionHolds) {
  sim::agents::Condition far, said;
  far.what = sim::agents::ApartBy{.a = kA, .b = kB, .above = 1000};
  said.what = sim::agents::InState{{sim::agents::Subjects::Quantifier::kOne, "b", {kB}}, "ON"};
  config.asked = {far, said};
  at(1s, befall(Fortune::kRemove, kB));
  begin_simulation([](const Event& event) -> std::vector<Action> {
    if (event.cause() != Cause::kStart) return {};
    return {state("ON")};
  });
  simulation_->run(Time{2s}, pace_);
  EXPECT_FALSE(simulation_->has_held(0));
  EXPECT_FALSE(simulation_->holds(1));
  EXPECT_TRUE(simulation_->has_held(1));
  for (const auto& quantity : sim::agents::quantities()) {
    if (quantity.domain == "agents" && quantity.has(config.agents[1], 0)) {
      EXPECT_EQ(simulation_->read(quantity, kB, 0), std::nullopt) << quantity.name;
    }
  }
}

TEST_F(Scripted, AnAddedAgentBeginsWhereItIsPutDown) {
  config.control_phase = sim::agents::ControlPhase::kUniform;
  config.agents[1].is_present = false;
  // Control instants at all phases of the physics' steps: one of them comes before the step.
  config.control_period = 1ms;
  at(1001ms, befall(Fortune::kAdd, kB));
  at(1002ms, {sim::agents::MoveTo{{15, 0, 0}}, "b", {kB}, {}});
  run(Time{2s}, nothing);
  const auto& track = whereabouts.track;
  ASSERT_FALSE(track.empty());
  EXPECT_GE(track.front().first, Time{1010ms});
  for (const auto& [time, x] : track) EXPECT_LT(x, 21) << hal::to_ns(time);
  EXPECT_NEAR(track.back().second, 15, 1e-3);
  EXPECT_EQ(whereabouts.displaced, (std::vector{Time{1010ms}, Time{1020ms}}));
  EXPECT_EQ(handed(kB, Cause::kStart, Time{1010ms}, Time{1010ms + 1ns}), 1u);
}

TEST_F(Scripted, WhatIsNotPresentDrawsNothing) {
  give_batteries();
  config.agents[1].is_present = false;
  at(1s, befall(Fortune::kAdd, kB));
  at(1500ms, befall(Fortune::kRemove, kB));
  begin_simulation();
  simulation_->run(Time{3s}, pace_);
  EXPECT_NEAR(simulation_->use(kA).energy.value(), 3 * 10 + 3 * 0.8, 0.01);
  EXPECT_NEAR(simulation_->use(kB).energy.value(), 0.5 * 10 + 0.5 * 0.8, 0.01);
}

TEST_F(Scripted, ABodyThatIsMovedIsThereWithTheNextStep) {
  at(1s, {sim::agents::MoveTo{{300, 5, 1}}, "b", {kB}, {}});
  port = std::make_shared<ScriptedPort>(nothing);
  sim::agents::Simulation simulation(config, {});
  simulation.connect(port, {kA, kB}, {});
  NoPace pace;
  simulation.run(Time{1100ms}, pace);
  EXPECT_NEAR(simulation.body(kB).x, 300, 1e-3);
  EXPECT_NEAR(simulation.body(kB).y, 5, 1e-3);
  EXPECT_NEAR(simulation.body(kB).theta, 1, 1e-3);
}

TEST_F(Scripted, TheRadioFollowsABodyThatIsMoved) {
  hop_over(sim::radio::Profile::kMobilityFramework);
  at(1s, {sim::agents::MoveTo{{1000, 0, 0}}, "b", {kB}, {}});
  at(1500ms, {sim::agents::MoveTo{{50, 0, 0}}, "b", {kB}, {}});
  run_sending(Time{2s});
  EXPECT_GT(handed(kA, Cause::kMessage, Time{}, Time{1s}), 0u);
  EXPECT_EQ(handed(kA, Cause::kMessage, Time{1020ms}, Time{1500ms}), 0u);
  EXPECT_GT(handed(kA, Cause::kMessage, Time{1500ms}, Time{2s}), 0u);
}

TEST_F(Scripted, LessPowerReachesLessFar) {
  hop_over(sim::radio::Profile::kMobilityFramework);
  config.agents[1].pose.x = 110;  // 100 m apart
  at(1s, {sim::agents::Retune{.tx_power = hal::Milliwatts{0.1}, .wheel_speed = {}}, "b", {kB}, {}});
  at(1500ms,
     {sim::agents::Retune{.tx_power = hal::Milliwatts{4}, .wheel_speed = {}}, "b", {kB}, {}});
  run_sending(Time{2s});
  EXPECT_GT(handed(kA, Cause::kMessage, Time{}, Time{1s}), 0u);
  EXPECT_EQ(handed(kA, Cause::kMessage, Time{1010ms}, Time{1500ms}), 0u);
  EXPECT_GT(handed(kA, Cause::kMessage, Time{1500ms}, Time{2s}), 0u);
}

TEST_F(Scripted, AJammerKeepsStationsFromSendingAsLongAsItLasts) {
  hop_over(sim::radio::Profile::kIeee80211b);
  at(1s, {sim::agents::Jam{.position = {15, 3, 0},
                           .power = hal::Milliwatts{100},
                           .channel = {},
                           .duration = 500ms,
                           .period = 10ms,
                           .duty_cycle = 1},
          {},
          {},
          {}});
  run_sending(Time{2s});
  EXPECT_GT(handed(kA, Cause::kMessage, Time{}, Time{1s}), 0u);
  EXPECT_EQ(handed(kA, Cause::kMessage, Time{1010ms}, Time{1500ms}), 0u);
  EXPECT_GT(handed(kA, Cause::kMessage, Time{1500ms}, Time{2s}), 0u);
}

TEST_F(Scripted, AJammersAntennaIsAboveTheGround) {
  config.world.ground = std::make_shared<Slope>(5e4, 0);  // m: from z = 3 m it would reach nobody
  hop_over(sim::radio::Profile::kIeee80211b);
  at(1s, {sim::agents::Jam{.position = {15, 3, 3},
                           .power = hal::Milliwatts{100},
                           .channel = {},
                           .duration = 500ms,
                           .period = 10ms,
                           .duty_cycle = 1},
          {},
          {},
          {}});
  run_sending(Time{1500ms});
  EXPECT_GT(handed(kA, Cause::kMessage, Time{}, Time{1s}), 0u);
  EXPECT_EQ(handed(kA, Cause::kMessage, Time{1010ms}, Time{1500ms}), 0u);
}

TEST_F(Scripted, EventsHappenAtTheirTimesAndAsOftenAsTheySay) {
  const ScriptedAction action = befall(Fortune::kSwitchOn, kA);
  config.script = {
      {sim::agents::Periodically{.every = 300ms, .from = 100ms, .until = {}, .count = 3},
       {action},
       {}},
      {sim::agents::Periodically{.every = 1s, .from = 1500ms, .until = 2600ms, .count = {}},
       {action},
       {}}};
  Done done;
  port = std::make_shared<ScriptedPort>(nothing);
  sim::agents::Simulation simulation(config, {&done});
  simulation.connect(port, {kA, kB}, {});
  NoPace pace;
  simulation.run(Time{5s}, pace);
  EXPECT_EQ(done.times,
            (std::vector{Time{100ms}, Time{400ms}, Time{700ms}, Time{1500ms}, Time{2500ms}}));
}

TEST_F(Scripted, AConditionMakesThemHappenOnceOrEachTime) {
  sim::agents::Condition b_is_on;
  b_is_on.what = sim::agents::InState{{sim::agents::Subjects::Quantifier::kOne, "b", {kB}}, "ON"};
  for (const bool each_time : {false, true}) {
    config.script = {
        {sim::agents::Whenever{b_is_on, each_time}, {befall(Fortune::kSwitchOn, kA)}, {}}};
    Done done;
    port = std::make_shared<ScriptedPort>([](const Event& event) -> std::vector<Action> {
      if (event.agent != kB || event.cause() != Cause::kControl) return {};
      return {state("ON"), state("OFF")};
    });
    sim::agents::Simulation simulation(config, {&done});
    simulation.connect(port, {kA, kB}, {});
    NoPace pace;
    simulation.run(Time{450ms}, pace);
    EXPECT_EQ(done.times.size(), each_time ? 5u : 1u);
  }
}

TEST_F(Scripted, AConditionEndsTheRunSomeTimeAfterItBeginsToHold) {
  sim::agents::Condition sent;
  sent.what = sim::agents::CountOf{.who = {sim::agents::Subjects::Quantifier::kAny, "*", {kA, kB}},
                                   .state = {},
                                   .topic = "test",
                                   .at_least = 5};
  config.ends = {{.agent = {}, .state = {}, .after = 1s, .result = "enough", .when = sent}};
  config.asked = {sent};
  port = std::make_shared<ScriptedPort>([](const Event& event) -> std::vector<Action> {
    if (event.cause() != Cause::kControl) return {};
    return {send(event.agent == kA ? kB : kA)};
  });
  sim::agents::Simulation simulation(config, {});
  simulation.connect(port, {kA, kB}, {});
  NoPace pace;
  const Outcome outcome = simulation.run(Time{5s}, pace);
  EXPECT_EQ(outcome.result, "enough");
  EXPECT_GE(outcome.ended_at, Time{1200ms});
  EXPECT_LT(outcome.ended_at, Time{1400ms});
  EXPECT_TRUE(simulation.holds(0));
  EXPECT_TRUE(simulation.has_held(0));
}

}  // namespace
}  // namespace tests
