// When a battery with `when_empty: off` is empty that heats itself, or drives motors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/battery_quadrature.h"
#include "tests/unit/sim/agents/batteries.h"
#include "tests/unit/sim/physics/robertino.h"

namespace tests {
namespace {

using hal::node::devices::Battery;

TEST_F(EmptyBattery, WithResistanceIsSoWhenANumericalIntegrationSays) {
  Battery one = one_watt(5);
  one.full_voltage = 3;
  one.empty_voltage = 2.4;
  one.resistance = 1.2;  // 1.2 W is what it can feed when empty
  give(kA, one);
  run(Time{20s});
  const double seconds = BatteryQuadrature(one, 1).seconds(5, 0, 20'000);  // 1e-10 s: its own test
  EXPECT_NEAR(hal::to_seconds(on_air(kA)), seconds, 1.2e-9);
  EXPECT_LT(seconds, 4.5) << "without resistance 5 s";
  EXPECT_NEAR(used[kA].energy.value(), 5, 5 * kExact);
  EXPECT_LT(used[kA].load.value(), 4.5);
}

// Steps of 10 us by the rule of Runge and Kutta from one change of the load to the next; its error
// in them is of the fifth power of 1e-5 s over some seconds, and vanishes in the rounding.
double emptied_after(const Battery& one, const std::vector<Seen::Air>& frames) {
  const auto power = [&](double joules, double watts) {
    const double u =
        one.empty_voltage + joules / one.capacity * (one.full_voltage - one.empty_voltage);
    return u * 2 * watts / (u + std::sqrt(u * u - 4 * one.resistance * watts));
  };
  double joules = one.capacity, now = 0;  // s
  const auto follow = [&](double until, double watts) {
    while (now < until && joules > 0) {
      const double h = std::min({1e-5, until - now, joules / power(joules, watts)});
      const double k1 = power(joules, watts), k2 = power(joules - h / 2 * k1, watts);
      const double k3 = power(joules - h / 2 * k2, watts), k4 = power(joules - h * k3, watts);
      joules -= h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      now = h == until - now ? until : now + h;
      if (h < 1e-15) return;
    }
  };
  for (const Seen::Air& frame : frames) {
    if (joules <= 0) break;
    follow(hal::to_seconds(frame.start - Time{}), one.idle_power + one.radio.listen);
    follow(hal::to_seconds(frame.end - Time{}), one.idle_power + one.radio.transmit);
  }
  follow(1e3, one.idle_power + one.radio.listen);
  return now;
}

TEST_F(EmptyBattery, WithResistanceFollowsEachFrame) {
  config.radio = sim::radio::profile_defaults(sim::radio::Profile::kDisk);
  for (auto& agent : config.agents) agent.routing = hal::node::routing::Algorithm::kNone;
  Battery one = last_battery(2);
  one.full_voltage = 4.2;
  one.empty_voltage = 3;
  one.resistance = 0.2;
  one.idle_power = 0.3;
  one.radio = {.transmit = 9, .receive = 0, .listen = 0.2, .off = 0};
  give(kA, one);
  run(Time{10s}, [](const Event& event) { return send_always_with(event, hal::Bytes(1000)); });
  ASSERT_GT(seen.frames.size(), 15u);
  EXPECT_NEAR(hal::to_seconds(on_air(kA)), emptied_after(one, seen.frames), 1.2e-9);
  EXPECT_NEAR(used[kA].energy.value(), 2, 2 * kExact);
  EXPECT_LT(used[kA].load.value(), 2 - 0.01) << "the rest is heat in the battery";
}

// The motors take from the battery in each step of the physics what they took in the step before.
class EmptyBatteryOfARobot : public EmptyBattery,
                             public testing::WithParamInterface<hal::node::devices::WheelLevel> {
 protected:
  void give_robot(const Battery& one) {
    auto robot = sim::physics::test::robertino(GetParam());
    robot.infrared.clear();
    for (auto& wheel : robot.wheels) wheel.stall_power = 14;
    config.agents[0].body = robot;
    give(kA, one);
  }
  void drive(Time until) {
    run(until, [](const Event& event) -> std::vector<Action> {
      if (event.agent != kA || event.cause() != Cause::kControl) return {};
      // To and fro.
      return {tests::drive(event.time.time_since_epoch() / 1s % 2 == 0 ? 0.5 : -0.5)};
    });
  }
};

TEST_P(EmptyBatteryOfARobot, EndsRadioAndMotorsWhenTheyHaveTakenWhatItHeld) {
  Battery one = last_battery(20);
  one.idle_power = 2;
  one.radio.listen = 0.5;
  give_robot(one);
  drive(Time{20s});
  EXPECT_NEAR(used[kA].energy.value(), 20, 20 * kExact);
  const hal::Duration on = on_air(kA);
  EXPECT_LT(on, 20s / 2.5 - 300ms) << "the motors took a share";
  EXPECT_GT(on, 1s);
  const double last_x = seen.track.back();
  EXPECT_NEAR(last_x, seen.track.at(seen.track.size() - 20), 1e-3) << "it stands";
  // The same way with a battery that lasts: what its loads have taken until then.
  Battery large = one;
  large.capacity = 2000;
  give_robot(large);
  drive(Time{on - 1ns});
  EXPECT_LT(used[kA].load.value(), 20);
  EXPECT_EQ(used[kA].radio.off, 0ns);
  const double watts = 2.5 + 3 * 14 + 23.56 * 3;  // no more than that
  EXPECT_GT(used[kA].load.value(), 20 - 2e-9 * watts);
  drive(Time{on});
  EXPECT_GE(used[kA].load.value(), 20 * (1 - kExact));
}

INSTANTIATE_TEST_SUITE_P(Wheels, EmptyBatteryOfARobot, sim::physics::test::kLevels,
                         sim::physics::test::level_name);

}  // namespace
}  // namespace tests
