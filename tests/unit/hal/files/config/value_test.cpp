#include "hal/files/config/value.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hal::files::config {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double parsed(std::string_view text, std::string_view unit) {
  const auto value = parse_value(text, unit, -1e300, 1e300);
  EXPECT_TRUE(value.has_value()) << text << ": " << value.error().message;
  return value.value_or(std::nan(""));
}

std::string refused(std::string_view text, std::string_view unit, double low = -1e300,
                    double high = 1e300) {
  const auto value = parse_value(text, unit, low, high);
  EXPECT_FALSE(value.has_value()) << text << " was read as " << *value;
  return value ? "" : value.error().message;
}

// Equality, not nearness: the nearest double to the decimal value is what a reader expects.
TEST(Value, ConvertsUnitsToTheNearestDouble) {
  EXPECT_EQ(parsed("10 ms", "s"), 0.01);
  EXPECT_EQ(parsed("250 us", "s"), 0.00025);
  EXPECT_EQ(parsed("2 min", "s"), 120);
  EXPECT_EQ(parsed("11 Mb/s", "b/s"), 11e6);
  EXPECT_EQ(parsed("5.5 Mb/s", "b/s"), 5.5e6);
  EXPECT_EQ(parsed("50 g", "kg"), 0.05);
  EXPECT_EQ(parsed("5 cm", "m"), 0.05);
  EXPECT_EQ(parsed("36 km/h", "m/s"), 10);
  EXPECT_EQ(parsed("15 mV", "V"), 0.015);
  EXPECT_EQ(parsed("1.0 N m", "N m"), 1);
}

TEST(Value, ConvertsAngles) {
  EXPECT_EQ(parsed("180 deg", "rad"), 3.14159265358979323846);
  EXPECT_EQ(parsed("-90 deg", "rad"), -3.14159265358979323846 / 2);
  EXPECT_DOUBLE_EQ(parsed("60 rpm", "rad/s"), 2 * 3.14159265358979323846);
}

TEST(Value, ConvertsPowerLevels) {
  EXPECT_DOUBLE_EQ(parsed("20 dBm", "mW"), 100);
  EXPECT_DOUBLE_EQ(parsed("0 dBm", "W"), 1e-3);
  EXPECT_DOUBLE_EQ(parsed("1 W", "dBm"), 30);
  // 10 log10 2 = 3.010299956639812, computed with bc.
  EXPECT_DOUBLE_EQ(parsed("2 mW", "dBm"), 3.010299956639812);
}

TEST(Value, TakesNumbersInDecimalNotation) {
  EXPECT_EQ(parsed("+.5", "1"), 0.5);
  EXPECT_EQ(parsed("-1e3", "1"), -1000);
  EXPECT_EQ(parsed("012", "1"), 12);  // decimal, though YAML 1.1 would say ten
  EXPECT_EQ(parsed("  7  m ", "m"), 7);
  EXPECT_EQ(parsed("7m", "m"), 7);
}

TEST(Value, RefusesWhatIsNotANumber) {
  for (const char* text : {"nan", "nan m", "inf m", ".inf", "infinity", "", "m", "- 5 m", "--5 m",
                           "+-5 m", ".m", "five m", "never", "none"}) {
    const std::string message = refused(text, "m");
    EXPECT_NE(message.find("is not a number"), std::string::npos) << message;
  }
  EXPECT_EQ(refused("nan dBm", "dBm"), "'nan dBm' is not a number");
  EXPECT_EQ(refused("1e999 m", "m"), "'1e999 m' is not a number");
}

TEST(Value, RefusesAnInfinityThatAConversionMakes) {
  EXPECT_EQ(refused("0 mW", "dBm"), "'0 mW' is not a finite number");
  EXPECT_EQ(refused("1e308 km", "m"), "'1e308 km' is not a finite number");
}

TEST(Value, InsistsOnAUnitOfTheRightDimension) {
  EXPECT_EQ(refused("15", "dBm"), "'15' must be written in dBm, e.g. '15 dBm'");
  EXPECT_EQ(refused("15 s", "m"), "'15 s' must be written in m, e.g. '15 m'");
  EXPECT_EQ(refused("15 dbm", "dBm"), "'15 dbm' must be written in dBm, e.g. '15 dBm'");
  EXPECT_EQ(refused("0x10 m", "m"), "'0x10 m' must be written in m, e.g. '0 m'");
  EXPECT_EQ(refused("15 dB", "dBm"), "'15 dB' must be written in dBm, e.g. '15 dBm'");
  EXPECT_EQ(refused("60", "rad"), "'60' must be written in rad or deg, e.g. '60 deg'");
  EXPECT_EQ(refused("3 s", "1"), "'3 s' must be a plain number, without a unit");
  EXPECT_EQ(refused("0x10", "1"), "'0x10' must be a plain number, without a unit");
}

TEST(Value, NamesTheLimitThatIsCrossed) {
  EXPECT_EQ(refused("45 dBm", "dBm", -30, 30), "45 dBm is above the limit of 30 dBm");
  EXPECT_EQ(refused("3000 ms", "s", 0, 2), "3000 ms is above the limit of 2 s");
  EXPECT_EQ(refused("-1", "1", 0.5, 2), "-1 is below the limit of 0.5");
}

TEST(Value, AcceptsTheLimitsThemselves) {
  EXPECT_EQ(*parse_value("2 s", "s", 2, 2), 2);
  EXPECT_FALSE(parse_value("2.0000001 s", "s", 2, 2));
}

TEST(Value, TakesNeverAndNoneOnlyWithoutUpperLimit) {
  EXPECT_EQ(*parse_value("never", "s", 0, kInfinity), kInfinity);
  EXPECT_EQ(*parse_value("none", "m", 0, kInfinity), kInfinity);
  EXPECT_FALSE(parse_value("never", "s", 0, 1e300));
  EXPECT_FALSE(parse_value("inf s", "s", 0, kInfinity));
  EXPECT_FALSE(parse_value("nan s", "s", 0, kInfinity));
}

TEST(Value, IsWrittenSoThatItReadsBackToTheSameBits) {
  for (const double value : {0.1, 1.0 / 3, 6.02e23, 5e-324, -7.25, 0.0, kInfinity}) {
    for (const char* unit : {"1", "s", "m", "dBm", "rad"}) {
      const auto again = parse_value(format_value(value, unit), unit, -1e300, kInfinity);
      ASSERT_TRUE(again) << again.error().message;
      EXPECT_EQ(*again, value) << unit;
    }
  }
}

TEST(Value, KnowsItsUnits) {
  EXPECT_TRUE(is_unit("m/s^2"));
  EXPECT_TRUE(is_unit("1"));
  EXPECT_FALSE(is_unit("furlong"));
  EXPECT_FALSE(is_unit(""));
}

}  // namespace
}  // namespace hal::files::config
