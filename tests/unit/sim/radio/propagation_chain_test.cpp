#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "hal/types/random.h"
#include "sim/radio/channel/neighbourhood.h"
#include "sim/radio/channel/propagation.h"
#include "sim/radio/radio_rules.h"
#include "tests/support/slope.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr auto kChained = Profile::kIeee80211b;

PropagationConfig& chain_of(Air& air) { return waves_of(air.config)->propagation; }

/// Broadcasts of one station, 100 ms apart.
void broadcast_often(Air& air, std::uint16_t station, int times) {
  for (int i = 0; i < times; ++i) {
    air.at(i * 100ms, [&air, station] { air.broadcast(station, 100); });
  }
}

/// RSSI of every frame at a receiver.
std::vector<double> levels(const Air& air, std::uint16_t receiver) {
  std::vector<double> found;
  for (const auto& reception : air.log.receptions) {
    if (reception.receiver.value == receiver) found.push_back(reception.rssi_dbm);
  }
  return found;
}

TEST(PropagationChain, LogDistanceAndShadowingAddUp) {
  std::set<double> seen;
  for (const double sigma : {0.0, 6.0}) {
    Air air(kChained);
    chain_of(air).chain = {LogDistanceConfig{}, ShadowingConfig{.sigma = hal::Decibels{sigma}}};
    air.add({0, 0, 0});
    air.add({10, 0, 0});
    air.build();
    broadcast_often(air, 1, 3);
    air.run();
    const auto found = levels(air, 2);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[0], found[2]) << "shadowing is frozen";
    // 16.0206 dBm less 46.6777 dB and 30 dB
    if (sigma == 0) {
      EXPECT_NEAR(found[0], 16.0206 - 76.6777, 1e-3);
    }
    seen.insert(found[0]);
  }
  EXPECT_EQ(seen.size(), 2u);
}

TEST(PropagationChain, FadesForStandingNodesOnlyIfScatterersMove) {
  for (const double speed : {0.0, 1.0}) {
    Air air(kChained);
    RayleighConfig fading;
    fading.scatterer_speed = speed;
    chain_of(air).chain = {LogDistanceConfig{}, fading};
    air.add({0, 0, 0});
    air.add({5, 0, 0});
    air.build();
    broadcast_often(air, 1, 8);
    air.run();
    const auto found = levels(air, 2);
    ASSERT_EQ(found.size(), 8u);
    const std::set<double> different(found.begin(), found.end());
    EXPECT_EQ(different.size(), speed > 0 ? 8u : 1u);
  }
}

/// What station 1's frames are at station 2, with so many others around.
std::vector<double> levels_among(int others, std::uint64_t seed = 1) {
  Air air(kChained);
  air.seed = seed;
  RicianConfig fading;
  fading.scatterer_speed = 1;
  chain_of(air).chain = {LogDistanceConfig{}, ShadowingConfig{}, fading};
  air.add({0, 0, 0});
  air.add({10, 0, 0});
  for (int i = 0; i < others; ++i) air.add({5, 3.0 + i, 0});
  air.build();
  broadcast_often(air, 1, 8);
  air.run();
  return levels(air, 2);
}

TEST(PropagationChain, OfALinkIsIndependentOfWhoElseExists) {
  ASSERT_EQ(levels_among(0).size(), 8u);
  EXPECT_EQ(levels_among(0), levels_among(1));
  EXPECT_EQ(levels_among(0), levels_among(5));
  EXPECT_NE(levels_among(0), levels_among(0, 2)) << "seeds must make a difference";
}

/// Of 200 stations, how many hear each other beyond a distance, m. Expects that the index of cells
/// finds all that hear each other.
std::size_t far_among_found(const std::vector<PathLossConfig>& chain, double side, double beyond) {
  RadioConfig config = profile_defaults(kChained);
  waves_of(config)->propagation.chain = chain;
  const Wall wall;
  const Propagation propagation(config, wall);
  EventQueue events;
  PlacedAntennas antennas;
  std::vector<Neighbourhood::Antenna> stations;
  hal::RandomStream random(1, "places");
  for (std::uint16_t i = 1; i <= 200; ++i) {
    const hal::Vec3 at{side * random.uniform(), side * random.uniform(), 0};
    stations.push_back({hal::AgentId{i}, hal::Milliwatts{40}, 0.1, random.next()});
    antennas.place(stations.back().agent, {at});
  }
  Neighbourhood neighbourhood(events, antennas, propagation, stations);
  std::size_t far = 0;
  for (StationIndex from = 0; from < stations.size(); ++from) {
    std::set<StationIndex> expected, found;
    const auto site = [&](StationIndex i) {
      return Site(antennas.position(stations[i].agent, {}), stations[i].height, stations[i].name);
    };
    for (StationIndex to = 0; to < stations.size(); ++to) {
      if (to == from) continue;
      const auto arrival = propagation.arrival(hal::Milliwatts{40}, site(from), site(to));
      if (arrival.power.value == 0) continue;
      expected.insert(to);
      const hal::Vec3 way = site(to).position - site(from).position;
      far += hal::dot(way, way) > beyond * beyond;
    }
    const Links& links = neighbourhood.links_from(from);
    for (const AudibleLink& link : links.audible) found.insert(link.receiver);
    for (const FaintLink& link : links.faint) found.insert(link.receiver);
    EXPECT_EQ(found, expected) << from;
  }
  return far;
}

// Gains of up to 3 sigma and 32 times the mean do not slip through the grid of cells.
TEST(PropagationChain, TheIndexFindsWhomAGainReaches) {
  // Reach of the mean: 223 m at -101 dBm.
  const auto far =
      far_among_found({LogDistanceConfig{}, ShadowingConfig{}, RayleighConfig{}}, 1000, 223);
  EXPECT_GT(far, 100u) << "the case must be tried";
}

// Rays in phase reach nearly twice as far as in free space: 7019 m at -101 dBm and 16.02 dBm.
TEST(PropagationChain, TheIndexFindsWhomRaysInPhaseReach) {
  const auto far = far_among_found({TwoRayInterferenceConfig{.reflection = 1}}, 40'000, 7100);
  EXPECT_GT(far, 100u) << "the case must be tried";
}

TEST(PropagationChain, MustHaveOneLawOfDistance) {
  for (const auto& chain : std::vector<std::vector<PathLossConfig>>{
           {},
           {ShadowingConfig{}},
           {FriisConfig{}, LogDistanceConfig{}},
           {FriisConfig{}, RayleighConfig{}, RicianConfig{}}}) {
    RadioConfig config = profile_defaults(kChained);
    waves_of(config)->propagation.chain = chain;
    EXPECT_THROW(check(config), std::invalid_argument);
  }
}

TEST(PropagationChain, TwoRayGroundTakesTheStationsHeights) {
  for (const double height : {1.5, 0.5}) {
    Air air(kChained);
    chain_of(air).chain = {TwoRayGroundConfig{}};
    chain_of(air).antenna_height = hal::Metres{height};
    air.add({0, 0, 0});
    air.add({300, 0, 0});
    air.build();
    broadcast_often(air, 1, 1);
    air.run();
    // 16.0206 dBm + 20 log10(height^2) - 40 log10(300 m); below -82 dBm: not noticed as a frame
    const double level = 16.0206 + 40 * std::log10(height / 300);
    if (level < -82) {
      EXPECT_TRUE(levels(air, 2).empty());
      continue;
    }
    ASSERT_EQ(levels(air, 2).size(), 1u);
    EXPECT_NEAR(levels(air, 2)[0], level, 1e-3);
  }
}

TEST(PropagationChain, TwoRayGroundTakesHeightsAboveTheGroundOfTheWorld) {
  const auto level_on = [](std::shared_ptr<const Ground> ground, double z) {
    Air air(kChained);
    chain_of(air).chain = {TwoRayGroundConfig{}};
    chain_of(air).antenna_height = hal::Metres{1.5};
    air.ground = std::move(ground);
    air.add({0, 0, z});
    air.add({300, 0, z});
    air.build();
    broadcast_often(air, 1, 1);
    air.run();
    return levels(air, 2).at(0);
  };
  // The same but for rounding: 1001.5 m - 1000 m is not 1.5 m to the last bit. dB
  EXPECT_NEAR(level_on(std::make_shared<tests::Slope>(1000, 0), 1000), level_on(kFlatGround, 0),
              1e-9);
}

}  // namespace
}  // namespace sim::radio::test
