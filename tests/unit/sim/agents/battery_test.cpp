#include "hal/node/devices/battery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/unit/sim/agents/batteries.h"
#include "tests/unit/sim/physics/robertino.h"

namespace {

using namespace tests;
using hal::node::devices::Battery;
using hal::node::devices::WhenEmpty;

constexpr Time kLastReading{2s};

// Two stations that hear each other and nobody else: what one sends, the other receives.
TEST_F(Batteries, FallByWhatComputerAndRadioDrewForTheFramesOnTheAir) {
  config.radio = sim::radio::profile_defaults(sim::radio::Profile::kIeee80211b);
  Battery one = tests::battery(100);
  one.idle_power = 0.5;
  one.radio = {.transmit = 700, .receive = 300, .listen = 0.2, .off = 0};
  give(tests::kA, one);
  give(tests::kB, one);
  run(kLastReading, tests::send_always);
  const double sent = seen.airtime(tests::kA, kLastReading),
               answered = seen.airtime(tests::kB, kLastReading);
  ASSERT_GT(sent, 0.005);
  ASSERT_GT(answered, 0.003);
  const double quiet = 2 - sent - answered;
  EXPECT_NEAR((1 - last(kA).at(0)) * 100, 0.5 * 2 + 700 * sent + 300 * answered + 0.2 * quiet,
              1e-6);
  EXPECT_NEAR((1 - last(kB).at(0)) * 100, 0.5 * 2 + 300 * sent + 700 * answered + 0.2 * quiet,
              1e-6);
  EXPECT_EQ(last(kA).at(1), 10);
  EXPECT_NEAR(last(kA).at(3), 100 * last(kA).at(0), 1e-12) << "J that are left";
  EXPECT_EQ(last(kA).at(4), 100) << "J when full";
}

TEST_F(Batteries, AnAgentThatStaysUpSendsOnAfterItsBatteryIsEmpty) {
  Battery one = tests::battery(1);
  one.idle_power = 1;
  give(tests::kA, one);
  run(Time{2s}, tests::send_always);
  EXPECT_EQ(last(kA).at(0), 0);
  EXPECT_TRUE(last(kB).empty()) << "it has none";
  EXPECT_EQ(messages(), 21);
  EXPECT_EQ(used[kA].energy, 1) << "no more than it held";
  EXPECT_NEAR(used[kA].load.value(), 2, 1e-12);
  EXPECT_EQ(used[kB].energy, std::nullopt);
  EXPECT_EQ(used[kB].load, std::nullopt);
}

TEST_F(Batteries, ARobotThatGoesOffRollsOutAndCannotBeSwitchedOnAgain) {
  auto robot = sim::physics::test::robertino(hal::node::devices::WheelLevel::kContact);
  robot.infrared.clear();
  config.agents[0].body = robot;
  Battery one = tests::battery(2);
  one.idle_power = 1;
  one.when_empty = WhenEmpty::kOff;
  give(tests::kA, one);
  run(Time{8s}, [](const Event& event) -> std::vector<Action> {
    if (event.agent != tests::kA || event.cause() != Cause::kControl) return {};
    std::vector<Action> actions = tests::send_always(event);
    actions.push_back(tests::drive(0.5));
    actions.push_back({.what = hal::node::exchange::SetRadio{true}});
    return actions;
  });
  EXPECT_EQ(last(kA).at(0), 0);
  EXPECT_EQ(last(kA).at(2), 0) << "it feeds nothing any more";
  EXPECT_LE(messages(), 20);
  // At 1 W and what the motors take to 0.5 m/s it is empty within 2 s, and stands at last.
  const std::vector<double>& track = seen.track;
  ASSERT_GT(track.size(), 70u);
  EXPECT_GT(track.back(), track.front() + 0.2);
  EXPECT_LT(track.back(), track.front() + 2.5);
  EXPECT_NEAR(track.back(), track.at(track.size() - 10), 1e-3);
}

}  // namespace
