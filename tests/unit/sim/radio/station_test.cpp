#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

/// Friis' range falls with the root of the power: at 2 mW it is 250.16 m, at 0.5 mW half of that.
class StationPower : public testing::TestWithParam<Profile> {};

TEST_P(StationPower, ReachAsFarAsTheirOwnPowerDoes) {
  Air air(GetParam());
  waves_of(air.config)->tx_power = hal::Milliwatts{2};
  waves_of(air.config)->propagation.interference_floor = hal::Dbm{-100};
  waves_of(air.config)->receiver.sensitivity = hal::Dbm{-85};
  waves_of(air.config)->receiver.cca_threshold = hal::Dbm{-85};
  waves_of(air.config)->propagation.wavelength = hal::Metres{0.125};
  air.add({0, 0, 0});
  air.add({200, 0, 0});
  air.set_tx_power(2, hal::Milliwatts{0.5});
  air.build();
  EXPECT_TRUE(air.network->links().empty()) << "a link goes both ways";
  air.broadcast(1);
  air.run(1s);
  air.broadcast(2);
  air.run(2s);
  EXPECT_EQ(air.inbox(2).received.size(), 1u);
  EXPECT_TRUE(air.inbox(1).received.empty());
  EXPECT_EQ(air.log.faint, 1u) << "of 2 at 1";
  EXPECT_DOUBLE_EQ(air.sap(1).transmit_energy(100), 4 * air.sap(2).transmit_energy(100));
}

INSTANTIATE_TEST_SUITE_P(WithAMedium, StationPower,
                         testing::Values(Profile::kMobilityFramework, Profile::kIeee80211b));

TEST(StationPowers, ArePositive) {
  Air air(Profile::kIeee80211b);
  air.add({0, 0, 0});
  air.set_tx_power(1, hal::Milliwatts{0});
  EXPECT_THROW(air.build(), std::invalid_argument);
}

/// Two stations 200 m apart with the replica's radio, which reaches 250.16 m.
class TwoStations : public testing::Test {
 protected:
  TwoStations() : air(Profile::kMobilityFramework) {}
  void place(double distance) { air.add_line(2, distance); }
  bool is_link() {
    air.build();
    return !air.network->links().empty();
  }

  Air air;
};

// Friis: twice the way costs 20 log10(2) = 6.0206 dB.
TEST_F(TwoStations, ReachTwiceAsFarWithSixDecibelsAtOneEnd) {
  place(500);
  air.station_config(2).antenna_gain = hal::Decibels{6.03};
  EXPECT_TRUE(is_link());
}

TEST_F(TwoStations, DoNotWithALittleLess) {
  place(500.5);
  air.station_config(1).antenna_gain = hal::Decibels{6.0};
  EXPECT_FALSE(is_link());
}

TEST_F(TwoStations, ReachFourTimesAsFarWithSixDecibelsAtBothEnds) {
  place(1000);
  waves_of(air.config)->propagation.antenna_gain = hal::Decibels{6.03};
  EXPECT_TRUE(is_link());
  EXPECT_DOUBLE_EQ(air.sap(1).transmit_energy(100), [] {
    Air plain(Profile::kMobilityFramework);
    plain.add({0, 0, 0});
    plain.build();
    return plain.sap(1).transmit_energy(100);
  }()) << "an antenna draws no power";
}

// The wavelength is for channel 1; 2412/2484 of it reaches 242.9 m instead of 250.16.
TEST_F(TwoStations, ReachLessFarOnAHigherChannel) {
  place(245);
  for (const std::uint16_t station : std::vector<std::uint16_t>{1, 2})
    air.station_config(station).channel = 14;
  EXPECT_FALSE(is_link());
}

TEST_F(TwoStations, ReachAsFarAsBeforeBelowThat) {
  place(242);
  for (const std::uint16_t station : std::vector<std::uint16_t>{1, 2})
    air.station_config(station).channel = 14;
  EXPECT_TRUE(is_link());
}

TEST(Channels, AreWorldsOfTheirOwn) {
  Air air(Profile::kIeee80211b);
  air.add_line(6, 10);
  for (const std::uint16_t station : std::vector<std::uint16_t>{2, 5})
    air.station_config(station).channel = 6;
  air.station_config(6).channel = 14;
  air.build();
  const auto links = air.network->links();
  EXPECT_EQ(links.size(), 4u) << "1, 3, 4 among each other, 2 and 5";
  for (std::uint16_t s = 1; s <= 6; ++s) air.broadcast(s, 1000);
  air.run();
  std::vector<std::size_t> heard;
  for (std::uint16_t s = 1; s <= 6; ++s) heard.push_back(air.inbox(s).received.size());
  // All send at once: on a channel with three of them nobody hears anybody, nor do the two.
  EXPECT_EQ(heard, (std::vector<std::size_t>{0, 0, 0, 0, 0, 0}));
  air.broadcast(1);
  air.run(2s);
  air.broadcast(2);
  air.run(3s);
  air.broadcast(6);
  air.run(4s);
  heard.clear();
  for (std::uint16_t s = 1; s <= 6; ++s) heard.push_back(air.inbox(s).received.size());
  EXPECT_EQ(heard, (std::vector<std::size_t>{0, 0, 1, 1, 1, 0}));
}

// The same frames at the same times whatever goes on on another channel.
TEST(Channels, DoNotDisturbEachOther) {
  const auto story = [](bool has_others) {
    Air air(Profile::kIeee80211b);
    air.add_line(4, 10);
    for (const std::uint16_t station : std::vector<std::uint16_t>{3, 4})
      air.station_config(station).channel = 2;
    air.build();
    for (int i = 0; i < 20; ++i) {
      air.send(1, 2, 500);
      air.send(2, 1, 500);
      if (has_others) air.send(3, 4, 500);
      if (has_others) air.send(4, 3, 500);
    }
    air.run();
    std::vector<std::pair<hal::Time, std::uint16_t>> starts;
    for (const auto& start : air.log.starts) {
      if (start.frame.transmitter.value <= 2) {
        starts.emplace_back(start.at, start.frame.transmitter.value);
      }
    }
    return starts;
  };
  EXPECT_EQ(story(true), story(false));
}

TEST(StationRates, AreTheirOwn) {
  Air air(Profile::kIeee80211b);
  air.add_line(2, 10);
  waves_of(air.config)->contention.rts_threshold = 0;
  air.station_config(1).data_rate = hal::BitsPerSecond{5.5e6};
  air.station_config(1).control_rate = hal::BitsPerSecond{2e6};
  air.station_config(1).broadcast_rate = hal::BitsPerSecond{11e6};
  air.build();
  air.send(1, 2, 100);
  air.run();
  air.send(2, 1, 100);
  air.run(2s);
  air.broadcast(1);
  air.broadcast(2);
  air.run(3s);
  std::vector<double> mbps;
  for (const auto& start : air.log.starts) {
    const FrameType type = start.frame.type;
    if (type == FrameType::kRts || type == FrameType::kData) {
      mbps.push_back(start.frame.rate.value / 1e6);
    }
  }
  EXPECT_EQ(mbps, (std::vector<double>{2, 5.5, 1, 11, 11, 1}));
}

TEST(StationConfigs, AreChecked) {
  const auto build = [](Profile profile, const StationConfig& config) {
    Air air(profile);
    air.add({0, 0, 0});
    air.station_config(1) = config;
    air.build();
  };
  EXPECT_THROW(build(Profile::kIeee80211b, {.channel = 15}), std::invalid_argument);
  EXPECT_THROW(build(Profile::kIeee80211b, {.standard = Standard::kIeee80211g}),
               std::invalid_argument);
  EXPECT_THROW(build(Profile::kIeee80211b, {.data_rate = hal::BitsPerSecond{54e6}}),
               std::invalid_argument);
  EXPECT_THROW(build(Profile::kIdeal, {.channel = 1}), std::invalid_argument);
  EXPECT_THROW(build(Profile::kIeee80211g,
                     {.standard = Standard::kIeee80211b, .data_rate = hal::BitsPerSecond{54e6}}),
               std::invalid_argument);
  build(Profile::kIeee80211g, {.standard = Standard::kIeee80211b});
}

}  // namespace
}  // namespace sim::radio::test
