// The instant at which a battery with `when_empty: off` is empty, and what ends there.
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/sim/agents/batteries.h"
#include "tests/unit/sim/physics/robertino.h"

namespace tests {
namespace {

using hal::node::devices::Battery;
using sim::agents::Befall;
using sim::agents::Drain;
using sim::agents::Fortune;

struct ProfileCase {
  std::string name;
  sim::radio::Profile profile;
};
class EmptyBatteryOfAnyRadio : public EmptyBattery,
                               public testing::WithParamInterface<ProfileCase> {};

TEST_P(EmptyBatteryOfAnyRadio, EndsTheRadioAtThatInstantAndHasGivenWhatItHeld) {
  config.radio = sim::radio::profile_defaults(GetParam().profile);
  give(kA, one_watt(1));
  give(kB, one_watt(3));
  run(Time{10s});
  EXPECT_EQ(on_air(kA), 1s);
  EXPECT_EQ(used[kA].radio.off, 9s);
  EXPECT_NEAR(used[kA].energy.value(), 1, kExact);
  EXPECT_NEAR(used[kA].load.value(), 1, kExact);
  EXPECT_EQ(on_air(kB), 3s);
  EXPECT_NEAR(used[kB].energy.value(), 3, 3 * kExact);
}

INSTANTIATE_TEST_SUITE_P(Profiles, EmptyBatteryOfAnyRadio,
                         testing::Values(ProfileCase{"Ideal", sim::radio::Profile::kIdeal},
                                         ProfileCase{"Disk", sim::radio::Profile::kDisk},
                                         ProfileCase{"MobilityFramework",
                                                     sim::radio::Profile::kMobilityFramework},
                                         ProfileCase{"Dcf", sim::radio::Profile::kIeee80211b}),
                         [](const auto& c) { return c.param.name; });

// The controllers' cycle has nothing to do with it, nor has it with whether they look.
TEST_F(EmptyBattery, IsSoBetweenControlInstantsAndWhoeverLooks) {
  Battery one = one_watt(1);
  one.capacity = 1.0123456789;
  give(kA, one);
  for (const hal::Duration period : {hal::Duration{1ms}, hal::Duration{100ms}, hal::Duration{7s}}) {
    config.control_period = period;
    run(Time{10s}, nothing, {.channels = {}});
    EXPECT_EQ(on_air(kA), hal::Duration{1'012'345'679}) << "rounded up to a nanosecond";
    run(Time{10s});
    EXPECT_EQ(on_air(kA), hal::Duration{1'012'345'679});
    EXPECT_NEAR(used[kA].energy.value(), one.capacity, kExact);
  }
}

TEST_F(EmptyBattery, OfASenderAndAReceiverHasGivenWhatItHeld) {
  use_dcf();
  Battery one = last_battery(2);
  one.idle_power = 0.5;
  one.radio = {.transmit = 70, .receive = 30, .listen = 0.2, .off = 0};
  give(kA, one);
  one.capacity = 3;
  give(kB, one);
  run(Time{20s}, send_always);
  for (const auto& [agent, joules] : {std::pair{kA, 2.0}, std::pair{kB, 3.0}}) {
    EXPECT_NEAR(used[agent].energy.value(), joules, kExact * joules);
    // Rounded up to a nanosecond of the load there was at last.
    EXPECT_GE(load_of(one, agent), joules * (1 - kExact));
    EXPECT_LT(load_of(one, agent), joules + 71 * 1e-9);
    EXPECT_NEAR(used[agent].load.value(), load_of(one, agent), kExact * joules);
    EXPECT_GT(used[agent].radio.transmitting, 500us);
    EXPECT_GT(used[agent].radio.receiving, 500us);
    EXPECT_GT(on_air(agent), 1s);
  }
}

TEST_F(EmptyBattery, CutsTheFrameThatItsRadioIsSending) {
  use_dcf();
  Battery one = last_battery(1);
  one.radio.transmit = 1000;
  give(kA, one);
  config.ends = {};
  run(Time{5s}, [](const Event& event) -> std::vector<Action> {
    if (event.agent != kA || event.cause() != Cause::kControl || event.time != Time{1s}) return {};
    return {send(kB, 1, hal::Bytes(1400))};  // more than 1 ms at 11 Mb/s
  });
  ASSERT_FALSE(seen.frames.empty());
  const auto cut = seen.frames.back();
  EXPECT_EQ(cut.from, kA);
  ASSERT_EQ(seen.cuts.size(), 1u);
  EXPECT_GT(seen.cuts[0], cut.start);
  EXPECT_LT(seen.cuts[0], cut.end);
  EXPECT_EQ(used[kA].radio.transmitting, 1ms) << "1 J at 1 kW";
  // The receiver, 10 m away, loses it at that instant; its sender hears that it has failed.
  EXPECT_EQ(seen.receptions.back(), std::pair(seen.cuts[0] + 33ns, hal::Verdict::kRadioOff));
  const auto notices = port->of(Cause::kNotice);
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(std::get<hal::node::exchange::Notice>(notices[0].what).fate, hal::Fate::kFailed);
  EXPECT_EQ(messages(), 0);
}

// What ends at that very instant has ended: the frame gets through, its acknowledgement does not.
TEST_F(EmptyBattery, LetsAFrameEndThatEndsAtThatInstant) {
  config.radio = sim::radio::profile_defaults(sim::radio::Profile::kDisk);
  for (auto& agent : config.agents) agent.routing = hal::node::routing::Algorithm::kNone;
  const auto once = [](const Event& event) -> std::vector<Action> {
    if (event.agent != kA || event.cause() != Cause::kControl || event.time != Time{1s}) return {};
    return {send(kB)};
  };
  run(Time{2s}, once);
  ASSERT_EQ(seen.frames.size(), 1u);
  const hal::Duration airtime = seen.frames[0].end - seen.frames[0].start;
  for (const hal::Duration missing : {0ns, 1ns}) {
    Battery one = last_battery(1000 * hal::to_seconds(airtime - missing));
    one.radio.transmit = 1000;
    give(kA, one);
    run(Time{2s}, once);
    EXPECT_EQ(used[kA].radio.transmitting, airtime - missing);
    EXPECT_EQ(messages(), missing == 0ns ? 1 : 0);
    EXPECT_EQ(seen.cuts.size(), missing == 0ns ? 0u : 1u);
  }
}

TEST_F(EmptyBattery, ThatADrainHasEmptiedEndsAtOnceOrEarlier) {
  give(kA, one_watt(1));
  give(kB, one_watt(5));
  at(400ms, Drain{.energy = 0.25, .level = {}}, kA);
  at(700ms, Drain{.energy = {}, .level = 0}, kB);
  run(Time{5s});
  EXPECT_EQ(on_air(kA), 750ms);
  EXPECT_NEAR(used[kA].energy.value(), 0.75, kExact);
  EXPECT_EQ(on_air(kB), 700ms);
  EXPECT_NEAR(used[kB].energy.value(), 0.7, kExact);
}

TEST_F(EmptyBattery, StaysOffWhateverHappens) {
  give(kA, one_watt(1));
  at(2s, Befall{Fortune::kSwitchOn}, kA);
  at(3s, Befall{Fortune::kRemove}, kA);
  at(4s, Befall{Fortune::kAdd}, kA);
  at(5s, Befall{Fortune::kRestart}, kA);
  for (auto& agent : config.agents) agent.program = "script";
  run(Time{10s});
  EXPECT_EQ(on_air(kA), 1s);
  EXPECT_NEAR(used[kA].energy.value(), 1, kExact);
}

// Its computer goes on.
TEST_F(EmptyBattery, OfWhatIsSwitchedOffLastsLonger) {
  give(kA, one_watt(1));
  at(400ms, Befall{Fortune::kSwitchOff}, kA);
  at(700ms, Befall{Fortune::kSwitchOn}, kA);
  run(Time{5s});
  EXPECT_EQ(used[kA].radio.off, 5s - 850ms);  // 300 ms at half the power
  EXPECT_NEAR(used[kA].energy.value(), 1, kExact);
}

TEST_F(EmptyBattery, LastsAsLongAsItsAgentTakesPart) {
  give(kA, one_watt(1));
  give(kB, one_watt(1));
  config.agents[1].is_present = false;
  for (auto& agent : config.agents) agent.program = "script";
  at(400ms, Befall{Fortune::kRemove}, kA);
  at(2s, Befall{Fortune::kAdd}, kA);
  at(1s, Befall{Fortune::kAdd}, kB);
  run(Time{5s});
  // Bodies come with the next step of the physics, 10 ms later.
  EXPECT_EQ(on_air(kA), 1s);
  EXPECT_EQ(on_air(kB), 1s);
  EXPECT_NEAR(used[kB].energy.value(), 1, kExact);
}

TEST_F(EmptyBattery, ThatIsEmptyAtTheStartIsOffFromTheStart) {
  Battery one = one_watt(1);
  one.charge = 0;
  give(kA, one);
  config.agents[1].body = sim::agents::Station{.path = {}, .sensors = {one_watt(2)}};
  run(Time{5s}, send_always);
  EXPECT_EQ(on_air(kA), 0s);
  EXPECT_EQ(used[kA].energy, 0);
  EXPECT_EQ(messages(), 0);
  EXPECT_EQ(on_air(kB), 2s) << "of a station, too";
}

TEST_F(EmptyBattery, EndsTheSensorsButTheGaugeAndNotTheController) {
  auto robot = sim::physics::test::robertino(hal::node::devices::WheelLevel::kContact);
  config.agents[0].body = robot;
  give(kA, one_watt(1.05));
  run(Time{2s}, nothing, {.channels = {"infrared", "odometry", "localisation", "battery"}});
  int lost = 0;
  for (const Event& event : port->of(Cause::kControl)) {
    if (event.agent != kA) continue;
    ASSERT_EQ(event.readings.size(), 4u) << "its controller lives on";
    for (const auto& reading : event.readings) {
      const bool is_gauge = reading.channel == hal::node::devices::kFirstSensor;
      EXPECT_EQ(reading.lost, !is_gauge && event.time >= Time{1050ms});
      lost += reading.lost ? 1 : 0;
    }
  }
  EXPECT_EQ(lost, 3 * 10);  // 1.1 s ... 2 s
  EXPECT_EQ(last(kA), (std::vector<double>{0, 10, 0, 0, 1.05}));
}

}  // namespace
}  // namespace tests
