#include "hal/node/devices/battery.h"

#include <gtest/gtest.h>

#include <string>

#include "hal/types/math.h"
#include "tests/support/battery_quadrature.h"

namespace hal::node::devices {
namespace {

using namespace std::chrono_literals;

Battery battery() {
  Battery one;
  one.capacity = 1000;  // J
  one.full_voltage = one.empty_voltage = 12;
  return one;
}

/// Like a worn pack of lead cells: 1 kJ, from 12.6 V down to 9 V.
Battery falling(double ohm) {
  Battery one = battery();
  one.full_voltage = 12.6;
  one.empty_voltage = 9;
  one.resistance = ohm;
  return one;
}

TEST(Discharge, WithoutResistanceTheChargeFallsWithTheEnergyDrawn) {
  Discharge discharge(battery());
  EXPECT_EQ(discharge.charge(), 1);
  EXPECT_EQ(discharge.open_voltage(), 12);
  EXPECT_EQ(discharge.drawn(), 0);
  EXPECT_EQ(discharge.coulombs(), 0);
  discharge.draw(24, 2s);
  EXPECT_NEAR(discharge.charge(), 1 - 48.0 / 1000, 1e-12);
  EXPECT_NEAR(discharge.energy(), 952, 1e-10);
  EXPECT_NEAR(discharge.drawn(), 48, 1e-12);
  EXPECT_NEAR(discharge.coulombs(), 4, 1e-12);  // A s: 24 W at 12 V for 2 s
  discharge.draw(0, 1s);
  EXPECT_NEAR(discharge.coulombs(), 4, 1e-12);
}

TEST(Discharge, ResistanceHeatsTheBattery) {
  Battery weak = battery();
  weak.resistance = 0.5;
  Discharge discharge(weak);
  discharge.draw(22, 1s);  // 2 A: 12 V - 0.5 ohm * 2 A = 11 V, times 2 A: 22 W
  EXPECT_NEAR(discharge.coulombs(), 2, 1e-12);
  EXPECT_NEAR(discharge.drawn(), 22 + 0.5 * 2 * 2, 1e-12);  // load and heat, J
  EXPECT_NEAR(discharge.lasts(22).value(), (1000 - 24) / 24.0, 1e-12);
  discharge.draw(22, 59s);
  EXPECT_EQ(discharge.charge(), 0) << "1440 J of 1000";
  EXPECT_NEAR(discharge.drawn(), 1000, 1e-12 * 1000);
  EXPECT_NEAR(discharge.coulombs(), 120, 1e-10) << "the load is fed on";
}

TEST(Discharge, MoreThanTheResistanceLetsThroughItDoesNotGive) {
  Battery weak = battery();
  weak.resistance = 2;
  Discharge discharge(weak);
  discharge.draw(100, 1s);                      // U^2 / 4 R is 18 W
  EXPECT_NEAR(discharge.coulombs(), 3, 1e-12);  // A s: U / 2 R
  EXPECT_NEAR(discharge.drawn(), 36, 1e-12);    // J
  EXPECT_NEAR(discharge.lasts(100).value(), 964 / 36.0, 1e-12);
}

TEST(Discharge, JustWhatTheResistanceLetsThroughItGivesAsLongAsTheVoltageHolds) {
  Battery weak = battery();
  weak.resistance = 2;
  Discharge discharge(weak);
  EXPECT_NEAR(discharge.lasts(18).value(), 1000 / 36.0, 1e-12);
  discharge.draw(18, 10s);
  EXPECT_NEAR(discharge.drawn(), 360, 1e-10);
}

// Without resistance d charge / dt = -P / capacity whatever the voltage, which follows the charge.
TEST(Discharge, TheVoltageFallsWithTheCharge) {
  Battery one = falling(0);
  one.charge = 0.8;
  Discharge discharge(one);
  EXPECT_NEAR(discharge.open_voltage(), 9 + 0.8 * 3.6, 1e-12);
  for (int i = 0; i < 60; ++i) discharge.draw(10, 1s);
  EXPECT_NEAR(discharge.charge(), 0.2, 1e-12);
  EXPECT_NEAR(discharge.open_voltage(), 9 + 0.2 * 3.6, 1e-12);
  // dQ = dE / U
  EXPECT_NEAR(discharge.coulombs(), 1000 / 3.6 * math::log((9 + 0.8 * 3.6) / (9 + 0.2 * 3.6)),
              1e-10);
  for (int i = 0; i < 60; ++i) discharge.draw(10, 1s);
  EXPECT_EQ(discharge.charge(), 0);
  EXPECT_EQ(discharge.open_voltage(), 9);
}

TEST(Discharge, WhatIsTakenIsNotDrawn) {
  Discharge discharge(battery());
  discharge.draw(100, 1s);
  discharge.take(400);
  EXPECT_NEAR(discharge.energy(), 500, 1e-12);
  EXPECT_NEAR(discharge.drawn(), 100, 1e-12);
  discharge.take(-700);
  EXPECT_EQ(discharge.charge(), 1) << "no fuller than full";
  discharge.take(2000);
  EXPECT_EQ(discharge.charge(), 0) << "no emptier than empty";
  EXPECT_EQ(discharge.lasts(1).value(), 0);
  EXPECT_NEAR(discharge.drawn(), 100, 1e-12);
}

TEST(Discharge, WithoutALoadItLastsForEver) {
  EXPECT_EQ(Discharge(falling(0.1)).lasts(0), std::nullopt);
}

TEST(Discharge, AMillionStepsAreAsGoodAsOne) {
  Discharge many(battery());
  for (int i = 0; i < 1'000'000; ++i) many.draw(0.1, 1ms);
  EXPECT_NEAR(many.drawn(), 100, 1e-12 * 100);
}

struct Load {
  std::string name;
  double ohm;
  double watts;
};

constexpr int kIntervals = 20'000;

class UnderLoad : public testing::TestWithParam<Load> {
 protected:
  const Battery one_ = falling(GetParam().ohm);
  const double watts_ = GetParam().watts;
  const tests::BatteryQuadrature quadrature_{one_, watts_};
};

// The rule with twice as many intervals would differ by 16 times less: 1e-10 s is more than both.
TEST_P(UnderLoad, AgreesWithANumericalIntegration) {
  ASSERT_NEAR(quadrature_.seconds(1000, 0, kIntervals),
              quadrature_.seconds(1000, 0, 2 * kIntervals), 1e-10);
  Discharge whole(one_), pieces(one_);
  const double all = whole.lasts(watts_).value();
  for (int tenths = 1; 0.1 * tenths < all; ++tenths) {
    pieces.draw(watts_, 100ms);
    whole = Discharge(one_);
    whole.draw(watts_, tenths * 100ms);
    ASSERT_NEAR(quadrature_.seconds(1000, whole.energy(), kIntervals), 0.1 * tenths, 1e-10);
    ASSERT_NEAR(pieces.energy(), whole.energy(), 1e-10);
    ASSERT_NEAR(whole.drawn() + whole.energy(), 1000, 1e-10);
    // What is left of the whole time is the rest of it.
    ASSERT_NEAR(pieces.lasts(watts_).value() + 0.1 * tenths, all, 1e-10);
    // dQ = dE / U
    const double coulombs = 1000 / 3.6 * math::log(12.6 / whole.open_voltage());
    ASSERT_NEAR(whole.coulombs(), coulombs, 1e-10);
    ASSERT_NEAR(pieces.coulombs(), coulombs, 1e-10);
  }
}

TEST_P(UnderLoad, IsEmptyAtTheInstantThatWasPredicted) {
  const double seconds = Discharge(one_).lasts(watts_).value();
  EXPECT_NEAR(seconds, quadrature_.seconds(1000, 0, kIntervals), 1e-10);
  Discharge to_the_end(one_);
  to_the_end.draw(watts_, Duration{static_cast<Duration::rep>(seconds * 1e9) - 1});
  EXPECT_GT(to_the_end.energy(), 0);
  // Of 2 ns; no load that is fed heats the battery by more than it gets.
  EXPECT_LT(to_the_end.energy(), 2 * watts_ * 2e-9);
  to_the_end.draw(watts_, 3ns);
  EXPECT_EQ(to_the_end.energy(), 0);
  EXPECT_NEAR(to_the_end.drawn(), 1000, 1e-12 * 1000);
}

// Limits: U^2 / 4 R is 40.5 W empty and 79.38 W full at 0.5 ohm.
INSTANTIATE_TEST_SUITE_P(Loads, UnderLoad,
                         testing::Values(Load{"None", 0, 50}, Load{"Small", 0.05, 50},
                                         Load{"Tiny", 1e-9, 50}, Load{"Large", 0.5, 40},
                                         Load{"AtTheLimitWhenEmpty", 0.5, 40.5},
                                         Load{"BeyondTheLimitLater", 0.5, 60},
                                         Load{"BeyondTheLimit", 0.5, 100}),
                         [](const auto& c) { return c.param.name; });

TEST(Discharge, AVoltageThatHardlyFallsIsAsGoodAsOneThatDoesNot) {
  Battery level = falling(0.5), sloping = level;
  level.full_voltage = level.empty_voltage;
  sloping.full_voltage = sloping.empty_voltage * (1 + 1e-12);
  EXPECT_NEAR(Discharge(sloping).lasts(30).value(), Discharge(level).lasts(30).value(), 1e-9);
  Discharge one(level), other(sloping);
  one.draw(30, 7s);
  other.draw(30, 7s);
  EXPECT_NEAR(one.energy(), other.energy(), 1e-8);
}

}  // namespace
}  // namespace hal::node::devices
