// Antennas that are not equal in all directions, on the air.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "hal/types/random.h"
#include "sim/radio/channel/neighbourhood.h"
#include "sim/radio/channel/propagation.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr double kTestPi = 3.14159265358979323846;

std::array<double, 4> yawed(double degrees) {
  const double half = degrees * kTestPi / 360;
  return {std::cos(half), 0, 0, std::sin(half)};
}

BeamAntenna narrow_beam() {
  return {.width = 40 * kTestPi / 180, .height = 20 * kTestPi / 180, .back = hal::Decibels{25}};
}

/// RSSI at station 2, 10 m ahead of station 1, which turns on the spot by a step before each frame.
std::vector<double> levels_while_turning(double degrees_per_frame, int frames) {
  Air air(Profile::kIeee80211b);
  waves_of(air.config)->propagation.chain = {FriisConfig{}};
  air.add({0, 0, 0});
  air.add({10, 0, 0});
  air.station_config(1).antenna = narrow_beam();
  // It may move, and does not: as a robot that turns on the spot.
  air.antennas.place(hal::AgentId{1}, {{0, 0, 0}, {}, yawed(0), 1});
  air.build();
  for (int i = 0; i < frames; ++i) {
    air.at(i * 100ms, [&air, i, degrees_per_frame] {
      air.antennas.place(hal::AgentId{1}, {{0, 0, 0}, {}, yawed(i * degrees_per_frame), 1});
      air.broadcast(1, 100);
    });
  }
  air.run(10s);
  std::vector<double> found;
  for (const auto& reception : air.log.receptions)
    if (reception.receiver.value == 2) found.push_back(reception.rssi_dbm);
  return found;
}

TEST(DirectedAntenna, RenewsThePowerOfAStationThatTurnsOnTheSpot) {
  const auto levels = levels_while_turning(10, 19);
  ASSERT_EQ(levels.size(), 19u);
  const double wavelength = 299792458 / 2.412e9;
  const double friis = 16.0206 + 20 * std::log10(wavelength / (4 * kTestPi * 10));
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double off = 10.0 * static_cast<double>(i) / 40;
    EXPECT_NEAR(levels[i], friis - std::min(12 * off * off, 25.0), 1e-3) << 10 * i << " degrees";
  }
}

TEST(DirectedAntenna, GainsInBothDirections) {
  // The beam of 1 is turned away by half its width from 2: as much is lost to it and from it.
  Air air(Profile::kIeee80211b);
  waves_of(air.config)->propagation.chain = {FriisConfig{}};
  air.add({0, 0, 0});
  air.add({10, 0, 0});
  air.station_config(1).antenna = narrow_beam();
  air.antennas.place(hal::AgentId{1}, {{0, 0, 0}, {}, yawed(20), 0});
  air.build();
  air.at(0ms, [&] { air.broadcast(1, 100); });
  air.at(100ms, [&] { air.broadcast(2, 100); });
  air.run();
  ASSERT_EQ(air.log.receptions.size(), 2u);
  EXPECT_NEAR(air.log.receptions[0].rssi_dbm, air.log.receptions[1].rssi_dbm, 1e-9);
  const double friis = 16.0206 + 20 * std::log10(299792458 / 2.412e9 / (4 * kTestPi * 10));
  EXPECT_NEAR(air.log.receptions[0].rssi_dbm, friis - 3, 1e-3);
}

/// 150 stations in a plane, with beams to all sides, some of which have turned since they were
/// looked at. The index finds exactly the links that a computation of all pairs finds.
TEST(DirectedAntenna, TheIndexFindsWhomABeamReaches) {
  RadioConfig config = profile_defaults(Profile::kIeee80211b);
  waves_of(config)->propagation.chain = {FriisConfig{}};
  const Wall wall;
  const Propagation propagation(config, wall);
  EventQueue events;
  PlacedAntennas antennas;
  std::vector<Neighbourhood::Antenna> stations;
  std::vector<hal::Vec3> places;
  hal::RandomStream random(1, "places");
  const auto pattern = std::make_shared<const AntennaPattern>(narrow_beam());
  for (std::uint16_t i = 1; i <= 150; ++i) {
    places.push_back({12'000 * random.uniform(), 12'000 * random.uniform(), 0});
    stations.push_back(
        {.agent = hal::AgentId{i}, .tx_power = hal::Milliwatts{40}, .gain = 2, .pattern = pattern});
    antennas.place(hal::AgentId{i}, {places.back(), {}, yawed(0), 1});
  }
  Neighbourhood neighbourhood(events, antennas, propagation, stations);
  for (StationIndex from = 0; from < stations.size(); ++from) neighbourhood.links_from(from);
  std::vector<DirectedAntenna> turned;
  for (std::uint16_t i = 1; i <= 150; ++i) {
    const auto attitude = yawed(360 * random.uniform());
    antennas.place(hal::AgentId{i}, {places[i - 1u], {}, attitude, 1});
    turned.emplace_back(*pattern, attitude);
  }
  std::size_t pairs = 0, lost = 0;
  for (StationIndex from = 0; from < stations.size(); ++from) {
    std::set<StationIndex> expected, found;
    const auto site = [&](StationIndex i) {
      Site one(places[i], 0, 0, stations[i].agent);
      one.directed = &turned[i];
      return one;
    };
    for (StationIndex to = 0; to < stations.size(); ++to) {
      if (to == from) continue;
      const auto arrival = propagation.arrival(hal::Milliwatts{160}, site(from), site(to));
      if (arrival.power.value > 0)
        expected.insert(to);
      else
        ++lost;
    }
    const Links& links = neighbourhood.links_from(from);
    for (const AudibleLink& link : links.audible) found.insert(link.receiver);
    for (const FaintLink& link : links.faint) found.insert(link.receiver);
    EXPECT_EQ(found, expected) << from;
    pairs += expected.size();
  }
  EXPECT_GT(pairs, 500u);
  EXPECT_GT(lost, 500u);
}

// Two rays: the ray from the ground leaves a beam that looks upwards lower than the direct one.
TEST(DirectedAntenna, WeighsTheReflectedRayByItsOwnDirection) {
  RadioConfig config = profile_defaults(Profile::kIeee80211b);
  waves_of(config)->propagation.chain = {TwoRayInterferenceConfig{.reflection = -0.6}};
  const Wall wall;
  const Propagation propagation(config, wall);
  const AntennaPattern pattern{narrow_beam()};
  const DirectedAntenna beam(pattern, yawed(0));
  Site from({0, 0, 0}, 5);
  const Site to({30, 0, 0}, 2);
  from.directed = &beam;
  const double lambda = 299792458 / 2.412e9;
  const double d1 = std::hypot(30, 3), d2 = std::hypot(30, 7);
  const double a1 = std::sqrt(pattern.towards({30, 0, -3})) / d1;
  const double a2 = -0.6 * std::sqrt(pattern.towards({30, 0, -7})) / d2;
  const double phase = 2 * kTestPi * (d2 - d1) / lambda;
  const double re = a1 + a2 * std::cos(phase), im = a2 * std::sin(phase);
  const double expected = std::pow(lambda / (4 * kTestPi), 2) * (re * re + im * im);
  const double found = propagation.steady(hal::Milliwatts{1}, from, to).free.value;
  EXPECT_NEAR(found / expected, 1, 1e-9);
}

}  // namespace
}  // namespace sim::radio::test
