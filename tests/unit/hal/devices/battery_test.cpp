#include "hal/devices/battery.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hal::devices {
namespace {

using namespace std::chrono_literals;

Battery battery() {
  Battery one;
  one.capacity = 1000;  // J
  one.full_voltage = one.empty_voltage = 12;
  return one;
}

TEST(Discharge, WithoutResistanceTheChargeFallsWithTheEnergyDrawn) {
  Discharge discharge(battery());
  EXPECT_EQ(discharge.charge(), 1);
  EXPECT_EQ(discharge.voltage(), 12);
  EXPECT_EQ(discharge.current(), 0);
  discharge.draw(48, 2s);
  EXPECT_NEAR(discharge.charge(), 1 - 48.0 / 1000, 1e-12);
  EXPECT_NEAR(discharge.current(), 2, 1e-12);  // A: 24 W at 12 V
  EXPECT_NEAR(discharge.voltage(), 12, 1e-12);
  discharge.draw(0, 1s);
  EXPECT_EQ(discharge.current(), 0);
}

TEST(Discharge, ResistanceHeatsTheBatteryAndLowersTheVoltage) {
  Battery weak = battery();
  weak.resistance = 0.5;
  Discharge discharge(weak);
  discharge.draw(60 * 22, 60s);  // 2 A: 12 V - 0.5 ohm * 2 A = 11 V, times 2 A: 22 W
  EXPECT_NEAR(discharge.current(), 2, 1e-12);
  EXPECT_NEAR(discharge.voltage(), 11, 1e-12);
  EXPECT_EQ(discharge.charge(), 0) << "1440 J of 1000";
  Discharge once(weak);
  once.draw(22, 1s);
  EXPECT_NEAR((1 - once.charge()) * weak.capacity, 22 + 0.5 * 2 * 2, 1e-9);  // load and heat, J
}

TEST(Discharge, MoreThanTheResistanceLetsThroughItDoesNotGive) {
  Battery weak = battery();
  weak.resistance = 2;
  Discharge discharge(weak);
  discharge.draw(100, 1s);                     // U^2 / 4 R is 18 W
  EXPECT_NEAR(discharge.current(), 3, 1e-12);  // A: U / 2 R
  EXPECT_NEAR(discharge.voltage(), 6, 1e-12);
  EXPECT_NEAR((1 - discharge.charge()) * weak.capacity, 36, 1e-9);
}

// d charge / dt = -P / capacity whatever the voltage, which follows the charge.
TEST(Discharge, TheVoltageFallsWithTheCharge) {
  Battery falling = battery();
  falling.empty_voltage = 9;
  falling.charge = 0.8;
  Discharge discharge(falling);
  EXPECT_NEAR(discharge.voltage(), 9 + 0.8 * 3, 1e-12);
  for (int i = 0; i < 60; ++i) discharge.draw(10, 1s);
  EXPECT_NEAR(discharge.charge(), 0.2, 1e-12);
  EXPECT_NEAR(discharge.voltage(), 9 + 0.2 * 3, 1e-12);
  for (int i = 0; i < 60; ++i) discharge.draw(10, 1s);
  EXPECT_EQ(discharge.charge(), 0);
  EXPECT_EQ(discharge.voltage(), 9);
}

}  // namespace
}  // namespace hal::devices
