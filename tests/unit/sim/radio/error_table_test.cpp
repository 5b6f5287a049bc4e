#include "sim/radio/phy/error_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hal/types/math.h"
#include "sim/radio/phy/mode_set.h"
#include "sim/radio/phy/ofdm_error_model.h"
#include "sim/radio/radio_rules.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr auto kHt = ModulationClass::kHt;
constexpr double kRounding = 1e-12;

/// HT MCS 7, of 100 and 1600 bytes.
ErrorTable two_sizes() {
  return {{kHt, 7, 100, 10, 1},    {kHt, 7, 100, 20, 0.5},  {kHt, 7, 100, 25, 0.1},
          {kHt, 7, 1600, 15, 0.9}, {kHt, 7, 1600, 25, 0.3}, {kHt, 7, 1600, 30, 0}};
}

double ratio(double db) { return hal::math::pow(10, db / 10); }

/// Error rate of a packet of so many bytes.
double per(const ErrorTable& table, double snr_db, double bytes) {
  return 1 - ErrorCurve(table).success(ratio(snr_db), 8 * bytes);
}

TEST(ErrorTable, IsExactAtItsRows) {
  for (const ErrorRow& row : two_sizes()) {
    EXPECT_NEAR(per(two_sizes(), row.snr_db, row.size), row.per, 1e-9) << row.snr_db;
  }
}

TEST(ErrorTable, IsLinearInDecibelsBetweenRows) {
  EXPECT_NEAR(per(two_sizes(), 16, 100), 0.7, kRounding);
  EXPECT_NEAR(per(two_sizes(), 21, 100), 0.42, kRounding);
  EXPECT_NEAR(per(two_sizes(), 18, 1600), 0.72, kRounding);
}

TEST(ErrorTable, LosesAllBelowItsRowsAndStaysAboveThem) {
  EXPECT_EQ(per(two_sizes(), 14.9, 1600), 1);
  EXPECT_NEAR(per(two_sizes(), 60, 100), 0.1, kRounding);
  const ErrorCurve curve(two_sizes());
  EXPECT_EQ(curve.success(0, 800), 0);
  EXPECT_NEAR(curve.success(std::numeric_limits<double>::infinity(), 800), 0.9, kRounding);
  EXPECT_EQ(curve.success(ratio(1), 0), 1) << "nothing to lose";
}

// 1 - (1 - p)^(L / L0); 400 bytes are the geometric mean of the two sizes.
TEST(ErrorTable, ConvertsTheNearestSize) {
  const auto of = [](double p, double share) { return 1 - std::pow(1 - p, share); };
  EXPECT_NEAR(per(two_sizes(), 20, 50), of(0.5, 0.5), kRounding);
  EXPECT_NEAR(per(two_sizes(), 20, 400), of(0.5, 4), kRounding);
  EXPECT_NEAR(per(two_sizes(), 25, 401), of(0.3, 401.0 / 1600), kRounding);
  EXPECT_NEAR(per(two_sizes(), 25, 3200), of(0.3, 2), kRounding);
}

TEST(ErrorTable, ReplacesTheFormulaForItsModesOnly) {
  Ieee80211acConfig config;
  config.error_table = two_sizes();
  config.error_table.push_back({ModulationClass::kOfdm, 7, 1600, 5, 1});
  config.error_table.push_back({ModulationClass::kOfdm, 7, 1600, 6, 0.25});
  const ModeSet modes{RadioConfig(config)};
  const double sinr = ratio(20);
  constexpr double kBits = 800;
  const auto at = [&](ModulationClass modulation, std::uint8_t mcs, std::uint16_t width) {
    return modes.at({modulation, mcs, 1, width, 800ns}).success(sinr, kBits);
  };
  EXPECT_NEAR(at(kHt, 7, 20), 0.5, kRounding);
  EXPECT_NEAR(at(kHt, 7, 40), 0.5, kRounding) << "by the SNR of a subcarrier, whatever the width";
  const Coding coding{Constellation::kQam64, CodeRate::kThreeQuarters};
  EXPECT_EQ(at(kHt, 6, 20), ofdm_success_probability(sinr, coding, kBits));
  EXPECT_EQ(at(ModulationClass::kVht, 6, 80), ofdm_success_probability(sinr, coding, kBits));
  EXPECT_NEAR(modes.at(hal::BitsPerSecond{54e6}).success(sinr, 8 * 1600), 0.75, kRounding);
  EXPECT_EQ(modes.at(hal::BitsPerSecond{48e6}).success(sinr, kBits),
            ofdm_success_probability(sinr, {Constellation::kQam64, CodeRate::kTwoThirds}, kBits));
}

/// Rows of this place and what is wrong with them.
std::string wrong(ErrorTable table, std::size_t place, const ErrorRow& row) {
  table.insert(table.begin() + static_cast<std::ptrdiff_t>(place), row);
  std::string text;
  for (const auto& [number, what] : wrong_rows(table)) text += std::to_string(number) + ": " + what;
  return text;
}

TEST(ErrorTable, NamesRowsThatCannotBe) {
  EXPECT_TRUE(wrong_rows(two_sizes()).empty());
  EXPECT_EQ(wrong(two_sizes(), 3, {kHt, 7, 100, 25, 0.1}),
            "3: snr_db: 25 is not above that of the row before, 25");
  EXPECT_EQ(wrong(two_sizes(), 3, {kHt, 7, 100, 26, 0.2}),
            "3: per: 0.2 is above that of the row before, 0.1, which has a lower SNR");
  EXPECT_EQ(wrong(two_sizes(), 6, {kHt, 7, 100, 40, 0}),
            "6: does not follow the other rows of its mode and size");
  EXPECT_EQ(wrong(two_sizes(), 6, {kHt, 6, 100, 40, 0}),
            "6: is the only row of its mode and size; two are needed");
}

TEST(ErrorTable, MustHaveAModeOfTheProfile) {
  Ieee80211gConfig config;
  config.error_table = two_sizes();
  const auto broken = broken_rules(RadioConfig(config));
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_EQ(broken.front().key, "error_table");
  EXPECT_EQ(broken.front().what, "has no mode of this profile");
  Ieee80211nConfig newer;
  newer.error_table = two_sizes();
  EXPECT_TRUE(broken_rules(RadioConfig(newer)).empty());
  newer.error_table.pop_back();
  newer.error_table.pop_back();
  EXPECT_EQ(broken_rules(RadioConfig(newer)).front().what,
            "row 4 is the only row of its mode and size; two are needed");
}

/// Transmissions of a frame over 5 m, where the SNR is far above all rows.
std::size_t frames_with(double error_rate) {
  Ieee80211nConfig config;
  config.aggregation.max_ampdu = 0;
  config.error_table = {{kHt, 7, 500, 0, 1}, {kHt, 7, 500, 1, error_rate}};
  Air air{RadioConfig(config)};
  air.add_line(2, 5);
  air.build();
  air.send(1, 2, 500);
  air.run();
  return air.log.starts.size();
}

TEST(ErrorTable, DecidesWhatArrives) {
  EXPECT_EQ(frames_with(0), 2u) << "the frame and its ACK";
  EXPECT_EQ(frames_with(1), 7u) << "short_retry_limit";
}

TEST(ErrorTable, NamesModes) {
  EXPECT_EQ(modes_with_error_tables().size(), 8u + 8 + 10 + 12);
  EXPECT_EQ(name_of_mode({ModulationClass::kOfdm, 1}), "OFDM9");
  EXPECT_EQ(name_of_mode({ModulationClass::kHe, 11}), "HE11");
}

}  // namespace
}  // namespace sim::radio::test
