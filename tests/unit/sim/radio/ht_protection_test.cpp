#include "sim/radio/mac/ht_protection.h"

#include <gtest/gtest.h>

#include <string>

#include "sim/radio/infrastructure/capability_elements.h"
#include "sim/radio/infrastructure/management.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

// IEEE Std 802.11-2020, 10.27.3.1.
TEST(HtProtection, IsWhatTheStationsAroundCallFor) {
  EXPECT_EQ(ht_protection({.width = 40}), HtProtection::kNone);
  EXPECT_EQ(ht_protection({.narrow_members = true, .width = 40}), HtProtection::k20Mhz);
  EXPECT_EQ(ht_protection({.narrow_members = true, .width = 20}), HtProtection::kNone);
  EXPECT_EQ(ht_protection({.non_ht_others = true, .narrow_members = true, .width = 40}),
            HtProtection::kNonmember);
  EXPECT_EQ(ht_protection({.non_ht_members = true, .non_ht_others = true, .width = 40}),
            HtProtection::kNonHtMixed);
}

TEST(HtOperationElement, HasItsFieldsInTheSecondOctetOfTheInformation) {
  const Capabilities own{
      .classes = 0x0f, .streams = 1, .width = 40, .short_guard = false};  // DSSS, OFDM, HT
  const HtOperation ht{
      .protection = HtProtection::kNonHtMixed, .non_greenfield = true, .obss_non_ht = true};
  hal::Bytes out;
  put_operation_elements(out, own, 6, ht);
  ASSERT_EQ(out.size(), 24U);
  EXPECT_EQ((hal::Bytes{out.begin(), out.begin() + 6}), (hal::Bytes{61, 22, 6, 0x05, 0x17, 0}));
  HtOperation read;
  take_ht_operation(61, std::span(out).subspan(2), read);
  EXPECT_EQ(read, ht);
  take_ht_operation(61, std::span(out).subspan(2, 2), read);
  take_ht_operation(45, std::span(out).subspan(2), read);
  EXPECT_EQ(read, ht) << "too short, and another element";
}

/// Station 1 is an access point of 40 MHz; how others are and whether they may use it is up to the
/// test.
class HtBss : public testing::Test {
 protected:
  HtBss() : air(Profile::kIeee80211n) {
    auto& n = std::get<Ieee80211nConfig>(air.config);
    n.mcs.width = 40;
    n.bss.access_points = {"s1"};
    n.aggregation.max_ampdu = 0;
    air.add({0, 0, 0});
  }

  StationConfig& add() {
    const auto place = static_cast<double>(++stations_);
    air.add({5 * place, 0, 0});
    return air.station_config(static_cast<std::uint16_t>(1 + stations_));
  }

  /// What the beacons of the access point say, in order, without repetitions.
  std::vector<HtOperation> told() const {
    std::vector<HtOperation> all;
    for (const Log::Start& start : air.log.starts) {
      if (start.frame.type != FrameType::kBeacon) continue;
      const HtOperation said = decode_beacon(*start.frame.payload)->bss.ht_operation;
      if (all.empty() || all.back() != said) all.push_back(said);
    }
    return all;
  }

  /// Frames since a moment: "CTS2 DATA2 ACK1".
  std::string story(std::size_t since) const {
    Log later;
    later.starts.assign(air.log.starts.begin() + static_cast<std::ptrdiff_t>(since),
                        air.log.starts.end());
    return later.story();
  }

  /// What 2 sends to the access point when all are associated.
  std::string exchange() {
    air.run(505ms);  // between two beacons
    const std::size_t since = air.log.starts.size();
    air.send(2, 1, 100);
    air.run(510ms);
    return story(since);
  }

  Air air;

 private:
  std::uint16_t stations_ = 0;
};

constexpr HtOperation kAlone{.protection = HtProtection::kNone};
constexpr HtOperation kPlain{.protection = HtProtection::kNone, .non_greenfield = true};

TEST_F(HtBss, OfStationsOfItsWidthAsksForNothing) {
  add();
  air.build();
  EXPECT_EQ(exchange(), "DATA2 ACK1");
  EXPECT_EQ(told(), (std::vector{kAlone, kPlain}));
}

TEST_F(HtBss, WithANarrowMemberSaysSoAndProtectsWideFramesIfTold) {
  for (const bool is_wide : {false, true}) {
    Air world(air.config);
    dcf_of(world.config)->wide_protection = is_wide;
    world.add({0, 0, 0});
    world.add({5, 0, 0});
    world.add({10, 0, 0});
    world.station_config(3).width = 20;
    world.build();
    world.run(505ms);
    const std::size_t since = world.log.starts.size();
    world.send(2, 1, 100);
    world.run(510ms);
    world.send(3, 1, 100);
    world.run(511ms);
    air.log = world.log;
    EXPECT_EQ(story(since), is_wide ? "CTS2 DATA2 ACK1 DATA3 ACK1" : "DATA2 ACK1 DATA3 ACK1")
        << "the narrow station has nothing to protect";
    EXPECT_EQ(told().back(),
              (HtOperation{.protection = HtProtection::k20Mhz, .non_greenfield = true}));
  }
}

// A station without HT is no member at first, and then one.
TEST_F(HtBss, WithAMemberWithoutHtIsMixed) {
  add();
  add().standard = Standard::kIeee80211g;
  air.build();
  EXPECT_EQ(exchange(), "CTS2 DATA2 ACK1");
  const std::vector<HtOperation> all = told();
  EXPECT_EQ(all.front(),
            (HtOperation{.protection = HtProtection::kNonmember, .obss_non_ht = true}));
  EXPECT_EQ(all.back(),
            (HtOperation{.protection = HtProtection::kNonHtMixed, .non_greenfield = true}));
}

TEST_F(HtBss, BesideAStationWithoutHtOfNoBssIsInNonmemberProtection) {
  add();
  StationConfig& other = add();
  other.standard = Standard::kIeee80211g;
  other.access_points = std::vector<std::string>{};
  air.build();
  EXPECT_EQ(exchange(), "CTS2 DATA2 ACK1");
  EXPECT_EQ(told().back(), (HtOperation{.protection = HtProtection::kNonmember,
                                        .non_greenfield = true,
                                        .obss_non_ht = true}));
}

// Members do what they are told, not what they know of the channel: here an access point that has
// forgotten them tells them of nobody.
TEST_F(HtBss, IsFollowedByItsMembers) {
  add();
  add();
  air.station_config(3).width = 20;
  dcf_of(air.config)->wide_protection = true;
  air.build();
  air.run(505ms);
  air.sap(1).set_radio(false);
  air.sap(1).set_radio(true);
  air.sap(3).set_radio(false);
  air.run(620ms);
  ASSERT_EQ(told().back().protection, HtProtection::kNone);
  const std::size_t before = air.log.starts.size();
  air.send(2, 1, 100);
  air.run(622ms);
  EXPECT_EQ(story(before).substr(0, 5), "DATA2");
}

}  // namespace
}  // namespace sim::radio::test
