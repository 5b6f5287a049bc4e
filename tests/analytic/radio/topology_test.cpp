#include <gtest/gtest.h>

#include <map>

#include "sim/radio/channel/propagation.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr hal::Milliwatts kSent{2};

RadioConfig replica() { return profile_defaults(Profile::kMobilityFramework); }

// Friis at 2 mW and 0.125 m: 0.125 / (4 pi) * sqrt(2 mW / 10^-8.5 mW) = 250.158 m; with
// c = 299792458 m/s over 2.4 GHz it is 249.985 m (docs/models.md, 4).
TEST(FriisRange, DecidesAboutTheReplicasGrid) {
  const Wall free_air;
  RadioConfig config = replica();
  EXPECT_NEAR(Propagation(config, free_air).reach(hal::Milliwatts{2}), 250.158, 5e-4);  // m
  waves_of(config)->propagation.wavelength = hal::Metres{299792458.0 / 2.4e9};
  EXPECT_NEAR(Propagation(config, free_air).reach(hal::Milliwatts{2}), 249.985, 5e-4);  // m
}

// Ranges that the paper prints, in m (docs/models.md, 4): printed with three or four digits, so
// tolerance is 0.5 %.
TEST(FriisRange, MatchesTheTableOfPowersAndSensitivities) {
  const Wall free_air;
  const std::map<std::pair<double, double>, double> table{
      {{0.5, -85}, 125.1}, {{1, -85}, 176.9},     {{2, -85}, 250.2}, {{100, -85}, 1769},
      {{2, -110}, 4449},   {{110.11, -80}, 1044}, {{0.5, -90}, 222}};
  for (const auto& [key, metres] : table) {
    const Propagation propagation(replica(), free_air);
    const double range =
        propagation.reach(hal::Milliwatts{key.first}, to_milliwatts(hal::Dbm{key.second}));
    EXPECT_NEAR(range, metres, 5e-3 * metres) << key.first << " mW, " << key.second << " dBm";
  }
}

TEST(PowerLaw, ExponentActsOnTheDistanceOnly) {
  const Wall free_air;
  RadioConfig config = replica();
  waves_of(config)->propagation.path_loss_exponent = 4;
  const Propagation fourth(config, free_air);
  const Propagation second(replica(), free_air);
  const double at_10 = fourth.arrival(kSent, hal::Vec3{}, hal::Vec3{10, 0, 0}).power.value;
  EXPECT_NEAR(at_10 * 1e4, second.arrival(kSent, hal::Vec3{}, hal::Vec3{1, 0, 0}).power.value,
              1e-15);  // mW
}

TEST(PowerLaw, NeverGivesMoreThanWasSent) {
  const Wall free_air;
  const Propagation propagation(replica(), free_air);
  EXPECT_EQ(propagation.arrival(kSent, hal::Vec3{}, hal::Vec3{}).power, kSent);
  EXPECT_EQ(propagation.arrival(kSent, hal::Vec3{}, hal::Vec3{1e-4, 0, 0}).power, kSent);
}

/// 25 motes, 125 m apart.
void add_grid(Air& air) {
  for (int i = 0; i < 25; ++i) air.add({125.0 * (i % 5), 125.0 * (i / 5), 0});
  air.build();
}

// By hand from the range of two cells (and not of sqrt(5) cells): number of grid neighbours within
// 2 cells of each place.
TEST(Grid, HasTheLinksAndDegreesOfFigure2) {
  Air air(replica());
  add_grid(air);
  const auto links = air.network->links();
  EXPECT_EQ(links.size(), 102u);
  std::map<int, int> degree;
  for (const auto& [a, b] : links) {
    EXPECT_LT(a, b);
    ++degree[a.value - 1];
    ++degree[b.value - 1];
  }
  const int expected[25] = {5, 7,  8,  7,  5,  //
                            7, 10, 11, 10, 7,  //
                            8, 11, 12, 11, 8,  //
                            7, 10, 11, 10, 7,  //
                            5, 7,  8,  7,  5};
  for (int i = 0; i < 25; ++i) EXPECT_EQ(degree[i], expected[i]) << "mote " << i;
}

TEST(Grid, HasTheSameLinksForDiskAndIdeal) {
  for (const Profile profile : {Profile::kDisk, Profile::kIdeal}) {
    Air air(profile);
    add_grid(air);
    EXPECT_EQ(air.network->links().size(), 102u);
  }
}

TEST(Grid, LosesEvery250MetreLinkWithTheExactSpeedOfLight) {
  Air air(replica());
  waves_of(air.config)->propagation.wavelength = hal::Metres{299792458.0 / 2.4e9};
  add_grid(air);
  EXPECT_EQ(air.network->links().size(), 72u);  // 102 less 2 * 15 of two cells
}

}  // namespace
}  // namespace sim::radio::test
