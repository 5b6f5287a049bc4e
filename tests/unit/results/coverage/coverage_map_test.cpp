#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "results/coverage/coverage.h"
#include "results/coverage/coverage_csv.h"
#include "results/coverage/coverage_figure.h"
#include "results/coverage/usable_rate.h"
#include "sim/radio/channel/propagation.h"
#include "sim/radio/phy/mode_set.h"
#include "tests/unit/results/coverage/floor.h"

namespace tests {
namespace {

using namespace results::coverage;
using sim::radio::MultiWallConfig;

constexpr double kRounding = 1e-9;  // dB

Coverage map_of(const sim::agents::SimulationConfig& config, const CoverageOptions& options = {}) {
  return coverage_of(config, options);
}

/// dBm at a place by hand: free space and the walls that are named.
double by_hand(const sim::agents::SimulationConfig& config, const hal::Vec3& from,
               const hal::Vec3& to, double walls) {
  const auto& waves = *waves_of(config.radio);
  const double metres = std::hypot(to.x - from.x, to.y - from.y, to.z - from.z);
  const double free =
      20 * std::log10(4 * std::numbers::pi * metres / waves.propagation.wavelength.value);
  return 10 * std::log10(waves.tx_power.value) + 2 * waves.propagation.antenna_gain.value - free -
         walls;
}

TEST(CoverageMap, HasTheMeanPowerBehindEachWall) {
  auto config = floor_with({});
  config.agents.resize(1);
  const Coverage map = map_of(config, {.step = hal::Metres{1}, .area = Area{{0, 0}, {20, 12}}});
  ASSERT_EQ(map.columns, 20u);
  ASSERT_EQ(map.rows, 12u);
  const hal::Vec3 ap{1, 1, 2.5};
  EXPECT_NEAR(map.at(2, 0).rssi.value, by_hand(config, ap, {2.5, 0.5, 1}, 0), kRounding);
  EXPECT_NEAR(map.at(7, 0).rssi.value, by_hand(config, ap, {7.5, 0.5, 1}, 3.5), kRounding);
  EXPECT_NEAR(map.at(19, 0).rssi.value, by_hand(config, ap, {19.5, 0.5, 1}, 3.5 + 0.6), kRounding);
}

TEST(CoverageMap, LeavesShadowingAndFadingOut) {
  const auto plain = floor_with({});
  auto faded = plain;
  waves_of(faded.radio)->propagation.chain.emplace_back(sim::radio::ShadowingConfig{});
  waves_of(faded.radio)->propagation.chain.emplace_back(sim::radio::RayleighConfig{});
  EXPECT_EQ(map_of(plain).rssi, map_of(faded).rssi);
}

TEST(CoverageMap, ChoosesTheStrongestAccessPoint) {
  const Coverage map = map_of(floor_with({}));
  ASSERT_EQ(map.transmitters.size(), 2u);
  for (std::size_t i = 0; i < map.spots.size(); ++i) {
    const std::size_t best = map.rssi[2 * i] >= map.rssi[2 * i + 1] ? 0 : 1;
    EXPECT_EQ(map.spots[i].best, best);
    EXPECT_EQ(map.spots[i].rssi.value, map.rssi[2 * i + best]);
  }
  EXPECT_EQ(map.at(4, 4).best, 0u);
  EXPECT_EQ(map.at(map.columns - 5, map.rows - 5).best, 1u);
}

TEST(CoverageMap, TakesOtherAgentsAndHeights) {
  auto config = floor_with({});
  dcf_of(config.radio)->bss.access_points.clear();
  EXPECT_THROW(map_of(config), std::runtime_error);
  const Coverage map = map_of(config, {.at = hal::Metres{2}, .of = "*1"});
  ASSERT_EQ(map.transmitters.size(), 1u);
  EXPECT_EQ(map.transmitters[0].name, "ap1");
  EXPECT_EQ(map.height, 2);
  EXPECT_GT(map_of(config, {.at = hal::Metres{4}, .of = "*1"}).at(2, 2).rssi.value,
            map_of(config, {.at = hal::Metres{1}, .of = "*1"}).at(2, 2).rssi.value + 3)
      << "above the walls, although farther away";
}

TEST(CoverageMap, TurnsAntennasWithTheirBodies) {
  auto config = floor_with({});
  config.agents.resize(1);
  const CoverageOptions options{.step = hal::Metres{1}, .area = Area{{0, 0}, {20, 12}}};
  const Coverage plain = map_of(config, options);
  config.agents[0].radio.antenna = sim::radio::BeamAntenna{};
  const Coverage ahead = map_of(config, options);
  config.agents[0].pose.theta = std::numbers::pi / 2;
  const Coverage left = map_of(config, options);
  const auto gain = [&](const Coverage& map, std::size_t column, std::size_t row) {
    return map.at(column, row).rssi.value - plain.at(column, row).rssi.value;
  };
  EXPECT_GT(gain(ahead, 12, 0), gain(ahead, 0, 11) + 5) << "x is ahead";
  EXPECT_GT(gain(left, 0, 11), gain(left, 12, 0) + 5) << "y is";
}

TEST(CoverageMap, RefusesARadioWithoutPowerLevels) {
  auto config = floor_with({});
  config.radio = sim::radio::profile_defaults(sim::radio::Profile::kDisk);
  EXPECT_THROW(map_of(config, {.of = "ap0"}), std::runtime_error);
}

// The highest rate whose frames arrive in at least 90 % of cases at this power, asked of each mode.
TEST(CoverageMap, ExpectsTheHighestUsableRate) {
  const auto config = floor_with({});
  const auto& waves = *waves_of(config.radio);
  const sim::radio::ModeSet modes(config.radio);
  const UsableRate usable(config.radio, 1500);
  double before = 0;
  int changes = 0;
  for (double dbm = -100; dbm < -40; dbm += 0.25) {
    const double snr = std::pow(10, (dbm - waves.receiver.noise_floor.value) / 10);
    double expected = 0;
    for (const auto& mode : modes.all()) {
      if (dbm < waves.receiver.sensitivity.value) continue;
      if (10 * std::log10(snr) < waves.receiver.min_sinr.value) continue;
      if (mode->rate() > modes.data().rate()) continue;
      const double arrives =
          mode->header_success(snr, 1) * mode->success(snr, mode->bits_at_risk(8 * 1500));
      if (arrives >= 0.9) expected = std::max(expected, mode->rate().value);
    }
    EXPECT_EQ(usable.at(hal::Dbm{dbm}).value, expected) << dbm;
    EXPECT_GE(expected, before) << dbm;
    changes += expected > before ? 1 : 0;
    before = expected;
  }
  EXPECT_EQ(before, modes.data().rate().value);
  EXPECT_GE(changes, 5) << "the case must be tried";
}

TEST(CoverageMap, IsARowOfCsvForEachPoint) {
  const Coverage map = map_of(floor_with({}), {.step = hal::Metres{2}});
  std::istringstream csv(coverage_csv(map));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "x_m,y_m,z_m,best,rssi_dbm,snr_db,rate_mbps,rssi_dbm[ap0],rssi_dbm[ap1]");
  std::size_t rows = 0;
  while (std::getline(csv, line)) {
    EXPECT_EQ(std::ranges::count(line, ','), 8);
    ++rows;
  }
  EXPECT_EQ(rows, map.spots.size());
}

TEST(CoverageMap, SharesAddUpToTheFloor) {
  auto config = floor_with({});
  waves_of(config.radio)->tx_power = hal::Milliwatts{1e-3};  // too weak for 54 Mb/s everywhere
  const Coverage map = map_of(config);
  for (const NamedLayer& one : kLayers) {
    const auto shares = shares_of(map, classes_of(map, one.layer));
    double sum = 0;
    for (const double share : shares) sum += share;
    EXPECT_NEAR(sum, 1, 1e-9) << one.name;
    EXPECT_GT(std::ranges::count_if(shares, [](double share) { return share > 0; }), 1) << one.name;
  }
}

/// Number of times that something occurs.
std::size_t occurrences(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++count;
  return count;
}

TEST(CoverageMap, IsDrawnWithWallsAndTransmitters) {
  const auto config = floor_with({});
  const Coverage map = map_of(config);
  for (const NamedLayer& one : kLayers) {
    const std::string svg = coverage_svg(map, one.layer, config.walls);
    EXPECT_EQ(occurrences(svg, "class=\"wall\""), config.walls.size()) << one.name;
    EXPECT_EQ(occurrences(svg, "class=\"transmitter\""), 2u) << one.name;
    // Runs of equal cells are one rectangle.
    const std::size_t cells = occurrences(svg, "<rect") - occurrences(svg, "height=\"14\"");
    EXPECT_GE(cells, map.rows) << one.name;
    EXPECT_LT(cells, map.spots.size()) << one.name;
  }
  const std::string page = coverage_page(map, "a & b", config.walls);
  EXPECT_EQ(occurrences(page, "<figure"), 4u);
  EXPECT_EQ(occurrences(page, "a &amp; b: coverage"), 2u);
  // A map above the walls has none.
  EXPECT_EQ(
      occurrences(coverage_svg(map_of(config, {.at = hal::Metres{4}}), Layer::kRssi, config.walls),
                  "class=\"wall\""),
      0u);
}

}  // namespace
}  // namespace tests
