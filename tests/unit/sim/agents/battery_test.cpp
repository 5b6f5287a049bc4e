#include "hal/devices/battery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "hal/devices/channels.h"
#include "sim/radio/frame.h"
#include "tests/unit/sim/agents/two_motes.h"
#include "tests/unit/sim/physics/robertino.h"

namespace {

using namespace tests;
using hal::devices::Battery;
using hal::devices::WhenEmpty;

constexpr Time kLastReading{2s};

Battery battery(double joules) {
  Battery one;
  one.capacity = joules;
  one.full_voltage = one.empty_voltage = 10;
  return one;
}

/// Time on the air of every station's frames, and where the first agent is.
class Seen final : public sim::agents::Observer {
 public:
  void on_body(Time, AgentId agent, const sim::agents::BodyState& body) override {
    if (agent == kA) track.push_back(body.x);
  }
  void on_frame_start(Time at, const sim::radio::Frame& frame) override {
    if (at < kLastReading) of[frame.transmitter] += frame.airtime;
  }
  std::map<AgentId, hal::Duration> of;
  std::vector<double> track;  ///< m, at control instants
};

class Batteries : public TwoMotes {
 protected:
  void give(AgentId agent, const Battery& one) {
    std::visit([&](auto& body) { body.sensors.emplace_back(one); },
               config.agents.at(agent.value - 1u).body);
  }

  Outcome run(Time until, ScriptedPort::Rule rule) {
    port = std::make_shared<ScriptedPort>(std::move(rule));
    sim::agents::Simulation simulation(config, {&effects, &seen});
    simulation.connect(port, {kA, kB}, {.channels = {}, .optional = {"battery"}});
    NoPace pace;
    return simulation.run(until, pace);
  }

  std::int64_t messages() const {
    return std::ranges::count(port->of(Cause::kMessage), kB, &Event::agent);
  }

  /// The last reading that a controller got: charge, voltage, current.
  std::vector<double> last(AgentId agent) const {
    std::vector<double> values;
    for (const Step& step : port->steps)
      for (const Event& event : step.events)
        for (const auto& reading : event.readings)
          if (event.agent == agent && reading.channel == hal::devices::kFirstSensor)
            values = reading.values;
    return values;
  }

  Seen seen;
};

/// The first agent sends a message to the second in each control cycle.
std::vector<Action> send_always(const Event& event) {
  if (event.agent != kA || event.cause != Cause::kControl) return {};
  Action message = send(kB);
  message.message_id = static_cast<hal::MessageId>(event.time.time_since_epoch() / 100ms + 1);
  return {message};
}

// Two stations that hear each other and nobody else: what one sends, the other receives.
TEST_F(Batteries, FallByWhatComputerAndRadioDrewForTheFramesOnTheAir) {
  config.radio = sim::radio::profile_defaults(sim::radio::Profile::kIeee80211b);
  Battery one = battery(100);
  one.idle_power = 0.5;
  one.radio = {.transmit = 700, .receive = 300, .listen = 0.2, .off = 0};
  give(kA, one);
  give(kB, one);
  run(kLastReading, send_always);
  const double sent = hal::to_seconds(seen.of[kA]), answered = hal::to_seconds(seen.of[kB]);
  ASSERT_GT(sent, 0.005);
  ASSERT_GT(answered, 0.003);
  const double quiet = 2 - sent - answered;
  EXPECT_NEAR((1 - last(kA).at(0)) * 100, 0.5 * 2 + 700 * sent + 300 * answered + 0.2 * quiet,
              1e-6);
  EXPECT_NEAR((1 - last(kB).at(0)) * 100, 0.5 * 2 + 300 * sent + 700 * answered + 0.2 * quiet,
              1e-6);
  EXPECT_EQ(last(kA).at(1), 10);
}

TEST_F(Batteries, AnAgentThatStaysUpSendsOnAfterItsBatteryIsEmpty) {
  Battery one = battery(1);
  one.idle_power = 1;
  give(kA, one);
  run(Time{2s}, send_always);
  EXPECT_EQ(last(kA).at(0), 0);
  EXPECT_TRUE(last(kB).empty()) << "it has none";
  EXPECT_EQ(messages(), 21);
}

TEST_F(Batteries, AnAgentThatGoesOffIsNotHeardAfterwards) {
  Battery one = battery(1);
  one.idle_power = 1;
  one.when_empty = WhenEmpty::kOff;
  give(kA, one);
  run(Time{2s}, send_always);
  // 0, 100 ms, ... 900 ms: at 1 s it is empty, and what is sent then comes too late.
  EXPECT_GE(messages(), 10);
  EXPECT_LE(messages(), 11);
}

TEST_F(Batteries, ARobotThatGoesOffRollsOutAndCannotBeSwitchedOnAgain) {
  auto robot = sim::physics::test::robertino(hal::devices::WheelLevel::kContact);
  robot.infrared.clear();
  config.agents[0].body = robot;
  Battery one = battery(2);
  one.idle_power = 1;
  one.when_empty = WhenEmpty::kOff;
  give(kA, one);
  run(Time{8s}, [](const Event& event) -> std::vector<Action> {
    if (event.agent != kA || event.cause != Cause::kControl) return {};
    Action drive;
    drive.kind = ActionKind::kDriveBody;
    drive.twist = {0.5, 0, 0};
    Action on;
    on.kind = ActionKind::kRadio;
    on.radio_on = true;
    std::vector<Action> actions = send_always(event);
    actions.push_back(drive);
    actions.push_back(on);
    return actions;
  });
  EXPECT_EQ(last(kA).at(0), 0);
  EXPECT_NEAR(last(kA).at(2), 0.1, 1e-9) << "its computer is on: 1 W at 10 V";
  EXPECT_LE(messages(), 20);
  // At 1 W and what the motors take to 0.5 m/s it is empty within 2 s, and stands at last.
  const std::vector<double>& track = seen.track;
  ASSERT_GT(track.size(), 70u);
  EXPECT_GT(track.back(), track.front() + 0.2);
  EXPECT_LT(track.back(), track.front() + 2.5);
  EXPECT_NEAR(track.back(), track.at(track.size() - 10), 1e-3);
}

}  // namespace
