#include <gtest/gtest.h>

#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

/// Stations 1 and 2 of 802.11g, 3 of 802.11b, 10 m apart.
class MixedCell : public testing::Test {
 protected:
  MixedCell() : air(Profile::kIeee80211g) {
    waves_of(air.config)->propagation.propagation_delay = false;
    air.add_line(3, 10);
    air.station_config(3).standard = Standard::kIeee80211b;
  }
  /// Frames and their rates, "CTS1@1 DATA1@54 ACK2@24".
  std::string story() const {
    std::string text;
    for (const auto& start : air.log.starts) {
      Log one;
      one.starts.push_back(start);
      if (!text.empty()) text += ' ';
      const std::string rate = std::to_string(start.frame.rate.value / 1e6);
      text += one.story() + '@' + rate.substr(0, rate.find('.'));
    }
    return text;
  }
  DcfConfig& dcf() { return *dcf_of(air.config); }

  Air air;
};

TEST_F(MixedCell, SendsToOldStationsInDsss) {
  air.build();
  air.send(1, 3, 100);
  air.run();
  EXPECT_EQ(story(), "DATA1@11 ACK3@1") << "no protection: all hear it";
}

TEST_F(MixedCell, SendsToGroupsInDsss) {
  air.build();
  air.broadcast(1, 100);
  air.run();
  EXPECT_EQ(story(), "DATA1@1");
  EXPECT_EQ(air.inbox(2).received.size(), 1u);
  EXPECT_EQ(air.inbox(3).received.size(), 1u);
}

TEST_F(MixedCell, ProtectsAsItIsTold) {
  struct Case {
    ProtectionKind kind;
    const char* story;
  };
  for (const Case& c : {Case{ProtectionKind::kAuto, "CTS1@2 DATA1@54 ACK2@24"},
                        Case{ProtectionKind::kCtsToSelf, "CTS1@2 DATA1@54 ACK2@24"},
                        Case{ProtectionKind::kRtsCts, "RTS1@2 CTS2@1 DATA1@54 ACK2@24"},
                        Case{ProtectionKind::kNone, "DATA1@54 ACK2@24"}}) {
    Air world(air.config);
    dcf_of(world.config)->protection = c.kind;
    dcf_of(world.config)->protection_rate = hal::BitsPerSecond{2e6};
    world.add_line(3, 10);
    world.station_config(3).standard = Standard::kIeee80211b;
    world.build();
    world.send(1, 2, 100);
    world.run();
    air.log = world.log;
    EXPECT_EQ(story(), c.story);
  }
}

TEST_F(MixedCell, SendsRtsThatAllUnderstand) {
  dcf().contention.rts_threshold = 0;
  air.build();
  air.send(1, 2, 100);
  air.run();
  air.send(1, 3, 100);
  air.run(2s);
  EXPECT_EQ(story(), "RTS1@1 CTS2@1 DATA1@54 ACK2@24 RTS1@1 CTS3@1 DATA1@11 ACK3@1");
}

TEST_F(MixedCell, HasTheLongSlot) {
  dcf().contention.slot = 9us;
  dcf().cca_time = 4us;
  air.build();
  for (int i = 0; i < 20; ++i) air.send(1, 2, 100);
  air.run();
  // From the end of the ACK, 34 us: SIFS, two slots and 0 .. 15 slots.
  for (std::size_t i = 2; i + 1 < air.log.starts.size(); i += 3) {
    const hal::Duration idle = air.log.starts[i + 1].at - air.log.starts[i].at - 34us;
    EXPECT_EQ((idle - 50us) % 20us, 0us);
    EXPECT_LE((idle - 50us) / 20us, 15);
  }
  EXPECT_EQ(air.log.starts.size(), 60u);
}

TEST_F(MixedCell, IsNoneOnAnotherChannel) {
  air.station_config(3).channel = 6;
  air.build();
  air.send(1, 2, 100);
  air.broadcast(1);
  air.run();
  EXPECT_EQ(story(), "DATA1@54 ACK2@24 DATA1@6");
}

TEST_F(MixedCell, IsNoneOfOldStationsOnly) {
  for (const std::uint16_t station : std::vector<std::uint16_t>{1, 2}) {
    air.station_config(station).standard = Standard::kIeee80211b;
  }
  air.build();
  air.send(1, 3, 100);
  air.run();
  EXPECT_EQ(story(), "DATA1@11 ACK3@1");
}

/// Power of station 1 at station 3, 100 m away: 16 dBm - 80.1 dB.
constexpr double kAt100Metres = -64.07;

// 10.26: what an old station gets of OFDM is energy. Below its threshold it sends into it at once.
TEST_F(MixedCell, OfdmIsEnergyToOldStations) {
  for (const double offset : {-1.0, 1.0}) {
    Air world(air.config);
    dcf_of(world.config)->protection = ProtectionKind::kNone;
    dcf_of(world.config)->receiver.energy_detection = hal::Dbm{kAt100Metres + offset};
    world.add({0, 0, 0});
    world.add({0, 10, 0});
    world.add({100, 0, 0});
    world.station_config(3).standard = Standard::kIeee80211b;
    world.build();
    world.send(1, 2, 1000);  // 182 us
    world.at(100us, [&world] { world.broadcast(3); });
    world.run();
    ASSERT_GE(world.log.starts.size(), 2u);
    const bool is_sensed = offset < 0;
    EXPECT_EQ(world.log.starts[1].frame.transmitter.value, is_sensed ? 2 : 3) << offset;
    EXPECT_EQ(world.log.verdicts(0, 3), std::vector{hal::Verdict::kPreambleMissed}) << offset;
  }
}

/// Lifetime of what waits, and of what is tried again.
class MsduLifetime : public testing::Test {
 protected:
  MsduLifetime() : air(Profile::kIeee80211b) {}
  Air air;
};

TEST_F(MsduLifetime, EndsFramesThatWaitTooLong) {
  dcf_of(air.config)->msdu_lifetime = 5ms;
  air.add_line(2, 10);
  air.build();
  for (std::uint64_t tag = 0; tag < 10; ++tag) air.send(1, 2, 1400, tag);  // 1.6 ms each
  air.run();
  ASSERT_EQ(air.inbox(1).ended.size(), 10u);
  std::size_t delivered = 0;
  for (const auto& end : air.inbox(1).ended) {
    const bool in_time = end.verdict == hal::Verdict::kDelivered;
    EXPECT_TRUE(in_time || end.verdict == hal::Verdict::kExpired);
    if (in_time) {
      EXPECT_EQ(end.tag, delivered) << "those that wait longest expire";
    }
    delivered += in_time ? 1u : 0u;
  }
  // The last one that is sent begins within 5 ms.
  EXPECT_EQ(air.inbox(2).received.size(), delivered);
  hal::Time last{};
  for (const auto& start : air.log.starts) {
    if (start.frame.type == FrameType::kData) last = start.at;
  }
  EXPECT_LE(last, hal::Time{} + 5ms);
  EXPECT_GE(delivered, 3u);
  EXPECT_LE(delivered, 4u);
}

TEST_F(MsduLifetime, EndsRetries) {
  dcf_of(air.config)->msdu_lifetime = 2ms;
  air.add_line(1, 10);
  air.build();
  air.send(1, 9, 100);  // nobody answers
  air.run();
  ASSERT_EQ(air.inbox(1).ended.size(), 1u);
  EXPECT_EQ(air.inbox(1).ended[0].verdict, hal::Verdict::kExpired);
  EXPECT_LT(air.log.starts.size(), 7u);
  for (const auto& start : air.log.starts) EXPECT_LE(start.at, hal::Time{} + 2ms);
}

TEST_F(MsduLifetime, OfOneFrameSaysNothingOfTheNext) {
  dcf_of(air.config)->msdu_lifetime = 2ms;
  air.add_line(2, 10);
  air.build();
  air.send(1, 9, 100);
  air.at(1900us, [this] { air.send(1, 2, 100); });
  air.run();
  ASSERT_EQ(air.inbox(1).ended.size(), 2u);
  EXPECT_EQ(air.inbox(1).ended[0].verdict, hal::Verdict::kExpired);
  EXPECT_EQ(air.inbox(1).ended[1].verdict, hal::Verdict::kDelivered);
}

}  // namespace
}  // namespace sim::radio::test
