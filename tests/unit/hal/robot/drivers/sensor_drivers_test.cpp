#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <thread>

#include "hal/robot/drivers/iio_imu.h"
#include "hal/robot/drivers/power_supply.h"
#include "tests/support/sysfs_folder.h"

namespace hal::robot::drivers {
namespace {

using namespace std::chrono_literals;
using tests::SysfsFolder;

constexpr DeviceTimes kTimes{2ms, 10ms, 60s};
constexpr Duration kPatience = 30s;  // of the wall clock: reached by a failing test only

bool until(const std::function<bool()>& condition) {
  const platform::BootTime end = platform::BootClock::now() + kPatience;
  while (!condition() && platform::BootClock::now() < end) std::this_thread::sleep_for(1ms);
  return condition();
}

/// The next measurement from now on.
std::vector<double> measured(const SensorDriver& driver) {
  const platform::BootTime now = platform::BootClock::now();
  EXPECT_TRUE(until([&] {
    const auto latest = driver.latest();
    return latest && latest->stamp > now + 2ms;
  })) << driver.trouble();
  const auto latest = driver.latest();
  return latest ? latest->values : std::vector<double>{};
}

TEST(PowerSupply, GivesChargeVoltageCurrentAndTheShareOfItsCapacity) {
  const SysfsFolder folder;
  folder.set("capacity", "73");
  folder.set("voltage_now", "11820000");
  folder.set("current_now", "-1250000");
  const auto driver = make_power_supply({folder.path(), kTimes, 1000});
  const auto values = measured(*driver);
  ASSERT_EQ(values.size(), 5u);
  EXPECT_NEAR(values[3], 730, 1e-9);
  EXPECT_EQ(values[4], 1000);
  EXPECT_NEAR(values[0], 0.73, 1e-12);
  EXPECT_NEAR(values[1], 11.82, 1e-12);
  EXPECT_NEAR(values[2], 1.25, 1e-12);
  folder.set("capacity", "72");
  EXPECT_NEAR(measured(*driver).at(0), 0.72, 1e-12);
}

TEST(PowerSupply, WithoutACurrentTheOthersAreThere) {
  const SysfsFolder folder;
  folder.set("capacity", "100");
  folder.set("voltage_now", "12600000");
  const auto driver = make_power_supply({folder.path(), kTimes});
  const auto values = measured(*driver);
  ASSERT_EQ(values.size(), 5u);
  EXPECT_EQ(values[0], 1);
  EXPECT_TRUE(std::isnan(values[2]));
  EXPECT_TRUE(std::isnan(values[3])) << "no capacity is known";
  EXPECT_TRUE(std::isnan(values[4]));
}

// A worn battery is full with less than it held when new.
TEST(PowerSupply, ThatMeasuresItsEnergyGivesThat) {
  const SysfsFolder folder;
  folder.set("capacity", "50");
  folder.set("voltage_now", "12600000");
  folder.set("energy_now", "10000000");   // uWh
  folder.set("energy_full", "20000000");  // uWh
  const auto driver = make_power_supply({folder.path(), kTimes, 90 * 3600});
  const auto values = measured(*driver);
  EXPECT_NEAR(values.at(3), 10 * 3600, 1e-6);
  EXPECT_NEAR(values.at(4), 20 * 3600, 1e-6);
  folder.set("energy_now", "none");
  EXPECT_TRUE(until([&] { return driver->trouble().find("energy_now") != std::string::npos; }));
}

TEST(PowerSupply, WhatIsNoNumberOrNotThereIsTroubleUntilItIsBack) {
  const SysfsFolder folder;
  folder.set("capacity", "much");
  folder.set("voltage_now", "12600000");
  const auto driver = make_power_supply({folder.path(), kTimes});
  ASSERT_TRUE(
      until([&] { return driver->trouble().find("is not a number") != std::string::npos; }));
  EXPECT_FALSE(driver->latest());
  folder.set("capacity", "50");
  EXPECT_EQ(measured(*driver).at(0), 0.5);
  folder.remove("voltage_now");
  EXPECT_TRUE(until([&] { return driver->trouble().find("voltage_now") != std::string::npos; }));
}

TEST(IioImu, ScalesRatesAndAccelerationsByTheirOwnOrTheTypesScale) {
  const SysfsFolder folder;
  int raw = 0;
  for (const std::string quantity : {"anglvel", "accel"})
    for (const std::string axis : {"x", "y", "z"})
      folder.set("in_" + quantity + "_" + axis + "_raw", std::to_string(raw++ * 100 - 250));
  folder.set("in_anglvel_scale", "0.001");
  folder.set("in_accel_scale", "0.01");
  folder.set("in_accel_z_scale", "0.02");
  const auto driver = make_iio_imu({folder.path(), kTimes});
  const auto values = measured(*driver);
  const std::vector<double> expected{-0.25, -0.15, -0.05, 0.5, 1.5, 5};
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(values[i], expected[i], 1e-12);
}

}  // namespace
}  // namespace hal::robot::drivers
