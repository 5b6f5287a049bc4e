#include <gtest/gtest.h>

#include <fmt/format.h>

#include "sim/radio/infrastructure/bss_config.h"
#include "sim/radio/infrastructure/management.h"
#include "sim/radio/radio_rules.h"
#include "sim/radio/station_profile.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

std::string text_of(const ModeId& id) {
  constexpr const char* kNames[] = {"none", "dsss", "ofdm", "ht", "vht", "he"};
  return fmt::format("{}{}/{}/{}/{}", kNames[static_cast<int>(id.modulation)], id.mcs, id.streams,
                     id.width, id.guard.count());
}

/// Three stations 5 m apart, the first and the second of the profile.
std::string story_of(const RadioConfig& config, const StationConfig& second,
                     const StationConfig& third) {
  Air air(config);
  waves_of(air.config)->propagation.propagation_delay = false;
  dcf_of(air.config)->aggregation.max_ampdu = 0;  // without asking for Block Ack first
  air.add_line(3, 5);
  air.station_config(2) = second;
  air.station_config(3) = third;
  air.build();
  air.send(1, 2, 500);
  air.run();
  std::string text;
  for (const auto& start : air.log.starts) {
    Log one;
    one.starts.push_back(start);
    text += (text.empty() ? "" : " ") + one.story() + "@" + text_of(start.frame.mode->id());
  }
  return text;
}

Ieee80211acConfig two_streams() {
  Ieee80211acConfig config;
  config.mcs.streams = 2;
  return config;
}

TEST(McsCell, SendsInTheModeOfItsKeysAndAnswersInOfdm) {
  EXPECT_EQ(story_of(Ieee80211nConfig{}, {}, {}), "DATA1@ht7/1/20/800 ACK2@ofdm4/1/20/800");
  EXPECT_EQ(story_of(two_streams(), {}, {}), "DATA1@vht9/2/80/800 ACK2@ofdm4/1/20/800");
  EXPECT_EQ(story_of(Ieee80211axConfig{}, {}, {}), "DATA1@he11/1/80/800 ACK2@ofdm4/1/20/800");
}

// QPSK 1/2 answers at 12 Mb/s, BPSK 1/2 at 6 (IEEE Std 802.11-2020, table 10-10).
TEST(McsCell, AnswersByTheReferenceRate) {
  Ieee80211nConfig config;
  const auto answer = [&config](std::uint8_t mcs) {
    config.mcs.mcs = mcs;
    const ModeSet modes{RadioConfig(config)};
    return modes.response_to(modes.data()).rate().value / 1e6;
  };
  EXPECT_EQ(answer(0), 6);
  EXPECT_EQ(answer(1), 12);
  EXPECT_EQ(answer(2), 12);
  EXPECT_EQ(answer(3), 24);
  EXPECT_EQ(answer(7), 24);
  config.basic_rates = {hal::BitsPerSecond{1e6}};
  EXPECT_EQ(answer(7), 24) << "the highest mandatory one of OFDM";
}

// The widest, with the most streams, that both have; MCS 9 in 20 MHz does not exist with 2 streams.
TEST(McsCell, SendsToLesserStationsWhatTheyKnow) {
  const auto to = [](const StationConfig& second) {
    const std::string story = story_of(two_streams(), second, {});
    return story.substr(0, story.find(' '));
  };
  EXPECT_EQ(to({.streams = 1}), "DATA1@vht9/1/80/800");
  EXPECT_EQ(to({.mcs = 8, .width = 20}), "DATA1@vht8/2/20/800");
  EXPECT_EQ(to({.standard = Standard::kIeee80211n}), "DATA1@ht7/2/40/800");
}

TEST(McsCell, ProtectsFromOlderStationsInWhatTheyKnow) {
  Ieee80211nConfig config;
  config.mcs.width = 40;
  EXPECT_EQ(story_of(config, {}, {.standard = Standard::kIeee80211g}),
            "CTS1@ofdm4/1/20/800 DATA1@ht7/1/40/800 ACK2@ofdm4/1/20/800");
  EXPECT_EQ(story_of(config, {}, {.standard = Standard::kIeee80211b}),
            "CTS1@dsss0/1/20/0 DATA1@ht7/1/40/800 ACK2@ofdm4/1/20/800");
  config.protection = ProtectionKind::kRtsCts;
  EXPECT_EQ(story_of(config, {}, {.standard = Standard::kIeee80211g}),
            "RTS1@ofdm4/1/20/800 CTS2@ofdm4/1/20/800 DATA1@ht7/1/40/800 ACK2@ofdm4/1/20/800");
  EXPECT_EQ(story_of(two_streams(), {}, {.standard = Standard::kIeee80211n}),
            "DATA1@vht9/2/80/800 ACK2@ofdm4/1/20/800")
      << "HT stations defer to VHT frames";
}

TEST(McsCell, SendsToOlderStationsAtTheReferenceRate) {
  EXPECT_EQ(story_of(Ieee80211nConfig{}, {.standard = Standard::kIeee80211g}, {}),
            "DATA1@ofdm7/1/20/800 ACK2@ofdm4/1/20/800");
  Ieee80211nConfig slow;
  slow.mcs.mcs = 1;
  EXPECT_EQ(story_of(slow, {.standard = Standard::kIeee80211b}, {}),
            "DATA1@dsss3/1/20/0 ACK2@dsss0/1/20/0");
}

// 5 GHz has no DSSS and no signal extension; SIFS is 16 us.
TEST(Band, OfFiveGigahertz) {
  Ieee80211nConfig config;
  const double wavelength = config.propagation.wavelength.value;
  set_channel(config, 36);
  EXPECT_EQ(config.contention.sifs, 16us);
  EXPECT_DOUBLE_EQ(config.propagation.wavelength.value, wavelength * 2412 / 5180);
  const ModeSet modes{RadioConfig(config)};
  EXPECT_EQ(modes.lowest().rate().value, 6e6);
  EXPECT_EQ(modes.lowest().airtime(8 * 14), 44us);
  EXPECT_EQ(modes.data().airtime(8 * 14), 36us + 4us);
  EXPECT_TRUE(broken_rules(RadioConfig(config)).empty());
  config.phy.broadcast_rate = hal::BitsPerSecond{1e6};
  EXPECT_FALSE(broken_rules(RadioConfig(config)).empty());
}

TEST(McsRules, NameWhatDoesNotExist) {
  const auto broken = [](const auto& config) {
    const auto rules = broken_rules(RadioConfig(config));
    return rules.empty() ? "" : rules.front().key;
  };
  Ieee80211nConfig n;
  n.mcs.width = 80;
  EXPECT_EQ(broken(n), "width");
  n = {};
  n.mcs.mcs = 8;
  EXPECT_EQ(broken(n), "mcs");
  Ieee80211acConfig ac;
  ac.mcs.width = 20;
  EXPECT_EQ(broken(ac), "mcs") << "MCS 9 in 20 MHz";
  ac.mcs.streams = 3;
  EXPECT_EQ(broken(ac), "");
  ac.phy.channel = 6;
  EXPECT_EQ(broken(ac), "channel");
  Ieee80211axConfig ax;
  ax.mcs.guard = 400ns;
  EXPECT_EQ(broken(ax), "guard_interval");
  ax = {};
  ax.aggregation.block_ack_window = 257;
  EXPECT_EQ(broken(ax), "aggregation.block_ack_window");
}

TEST(BeaconRate, IsThatOfBroadcastsUnlessItIsGiven) {
  Ieee80211nConfig config;
  EXPECT_EQ(ModeSet(RadioConfig(config)).beacon().rate().value, 6e6);
  config.beacon_rate = hal::BitsPerSecond{1e6};
  EXPECT_EQ(ModeSet(RadioConfig(config)).beacon().rate().value, 1e6);
}

// What a beacon says of its sender is what a station is told of it.
TEST(CapabilityElements, ComeBack) {
  Ieee80211axConfig ax = {};
  ax.mcs.streams = 3;
  Ieee80211nConfig n;
  n.mcs.guard = 400ns;
  n.mcs.width = 40;
  for (const RadioConfig& config : {RadioConfig(ax), RadioConfig(two_streams()), RadioConfig(n)}) {
    Capabilities own = capabilities_of(config);
    Beacon beacon{.interval = 100 * kTimeUnit, .bss = {.ssid = "x", .rates = {12}}};
    beacon.bss.capabilities = own;
    beacon.bss.primary_channel = static_cast<std::uint8_t>(waves_of(config)->phy.channel);
    const auto decoded = decode_beacon(encode(beacon));
    ASSERT_TRUE(decoded && decoded->bss.capabilities);
    constexpr unsigned kWithoutMcs = 0x07;  // no element states those classes
    own.classes = static_cast<std::uint8_t>(own.classes & ~kWithoutMcs);
    EXPECT_EQ(*decoded->bss.capabilities, own) << profile_name(config);
  }
}

}  // namespace
}  // namespace sim::radio::test
