#include <algorithm>

#include "sim/radio/infrastructure/heard_access_points.h"
#include "tests/unit/sim/radio/bss.h"

namespace sim::radio::test {
namespace {

using hal::Verdict;

constexpr hal::AgentId kLeft{1}, kRight{2};

/// Two access points, 1 and 2, 100 m apart.
class Roaming : public BssTest {
 protected:
  Roaming() {
    waves_of(air.config)->propagation.path_loss_exponent = 3;
    dcf().bss.access_points = {"s1", "s2"};
    air.add({0, 0, 0});
    air.add({100, 0, 0});
  }
  /// Where station 3, which walks from 10 m on with the speed [m/s], was when its n-th association
  /// began.
  double place_of(std::size_t n, double speed) const {
    return 10 + speed * hal::to_seconds(air.log.associations.at(n).at);
  }
};

TEST_F(Roaming, TargetTimesOfBeaconsAreSpreadOverTheInterval) {
  air.build();
  air.run(150ms);
  ASSERT_EQ(air.log.story(), "BEACON1 BEACON2 BEACON1");
  EXPECT_EQ(start_of(1), 51200us);
  EXPECT_EQ(start_of(2), 102400us);
}

TEST_F(Roaming, StationTakesTheStrongerOne) {
  air.add({70, 0, 0});
  air.build();
  air.run(200ms);
  ASSERT_EQ(associations.size(), 1u);
  EXPECT_EQ(associations[0].access_point, kRight);
}

TEST_F(Roaming, StationTakesTheOneThatItMayUse) {
  air.add({70, 0, 0});
  air.set_access_points(3, {"s1"});
  air.build();
  air.run(2s);
  ASSERT_EQ(associations.size(), 1u);
  EXPECT_EQ(associations[0].access_point, kLeft);
}

// With the exponent 3 the right one is h dB stronger where x / (100 - x) = 10^(h / 30), and the
// newest beacon is all that counts here: at 1 m/s one comes every 0.1 m.
TEST_F(Roaming, HandoverIsWhereTheHysteresisPutsIt) {
  for (const double hysteresis : {0.0, 4.0, 8.0}) {
    Air walk(air.config);
    dcf_of(walk.config)->bss.hysteresis = hal::Decibels{hysteresis};
    dcf_of(walk.config)->bss.beacon_weight = 1;
    walk.add({0, 0, 0});
    walk.add({100, 0, 0});
    walk.add({10, 0, 0}, {1, 0, 0});
    walk.build();
    walk.run(80s);
    ASSERT_EQ(walk.log.associations.size(), 2u) << hysteresis;
    const double ratio = std::pow(10.0, hysteresis / 30);
    const double x = 10 + hal::to_seconds(walk.log.associations[1].at);
    EXPECT_GE(x, 100 * ratio / (1 + ratio)) << hysteresis;
    EXPECT_LE(x, 100 * ratio / (1 + ratio) + 0.2) << hysteresis;
  }
}

TEST_F(Roaming, MeanOfBeaconsIsLate) {
  dcf().bss.beacon_weight = 0.1;
  air.add({10, 0, 0}, {1, 0, 0});
  air.build();
  air.run(80s);
  ASSERT_EQ(associations.size(), 2u);
  const double ratio = std::pow(10.0, 4.0 / 30);
  // The mean is that of 9 beacons ago, 0.92 m.
  EXPECT_NEAR(place_of(1, 1), 100 * ratio / (1 + ratio) + 0.9, 0.25);
}

TEST_F(Roaming, GoesOverAndBackWithFourFramesEach) {
  air.add({10, 0, 0}, {2, 0, 0});
  air.build();
  air.run(30s);
  air.antennas.place(hal::AgentId{3}, {{130, 0, 0}, {-2, 0, 0}});  // 70 m at 30 s
  air.run(60s);
  ASSERT_EQ(associations.size(), 3u);
  EXPECT_EQ(associations[0].access_point, kLeft);
  EXPECT_EQ(associations[1].access_point, kRight);
  EXPECT_EQ(associations[2].access_point, kLeft);
  const auto sent = types();
  EXPECT_EQ(std::ranges::count(sent, FrameType::kAuthentication), 6);
  EXPECT_EQ(std::ranges::count(sent, FrameType::kAssociationRequest), 1);
  EXPECT_EQ(std::ranges::count(sent, FrameType::kReassociationRequest), 2);
  EXPECT_EQ(std::ranges::count(sent, FrameType::kReassociationResponse), 2);
}

TEST_F(Roaming, StationBetweenTheTwoStaysWhereItIs) {
  air.add({48, 0, 0}, {0.8, 0, 0});
  air.build();
  air.run(5s);  // 52 m: 1 dB stronger, below the hysteresis
  EXPECT_EQ(associations.size(), 1u);
}

TEST_F(Roaming, AccessPointSwitchedOffIsReplacedByTheOther) {
  air.add({30, 0, 0});
  air.build();
  air.at(1s, [this] { air.sap(1).set_radio(false); });
  air.at(1500ms, [this] { air.send(3, 2, kPayload, 5); });  // still with the dead one
  air.run(4s);
  ASSERT_EQ(associations.size(), 3u);
  EXPECT_EQ(associations[1].access_point, std::nullopt);
  EXPECT_EQ(associations[2].access_point, kRight);
  EXPECT_GE(associations[1].at, hal::Time{} + 1s + 900ms);
  EXPECT_EQ(verdict_of(3, 5), Verdict::kRetryLimit);
}

TEST_F(Roaming, FramesFindTheirStationBehindTheOtherAccessPoint) {
  dcf().bss.distribution_delay = 5ms;
  air.add({10, 0, 0});
  air.add({90, 0, 0});
  air.build();
  air.run(210ms);
  forget();
  air.send(3, 4, kPayload, 1);
  air.run(216ms);
  EXPECT_EQ(air.log.story(), "DATA3 ACK1 DATA2 ACK4");
  EXPECT_EQ(start_of(2), start_of(0) + air.log.starts[0].frame.airtime + 5ms);  // idle: at once
  ASSERT_EQ(air.inbox(4).received.size(), 1u);
  EXPECT_EQ(air.inbox(4).received[0].indication.source, hal::AgentId{3});
}

// The two do not hear each other: without the delay their frames would collide at station 5.
TEST_F(Roaming, GroupFramesGoOutOfEveryAccessPointAndComeInOnce) {
  dcf().bss.distribution_delay = 5ms;
  air.add({10, 0, 0});
  air.add({90, 0, 0});
  air.add({45, 0, 0});
  air.build();
  air.run(210ms);
  air.broadcast(3, kPayload);
  air.run(230ms);
  air.broadcast(2, kPayload);
  air.run(250ms);
  EXPECT_EQ(air.inbox(1).received.size(), 2u);
  EXPECT_EQ(air.inbox(2).received.size(), 1u);
  EXPECT_EQ(air.inbox(3).received.size(), 1u);
  EXPECT_EQ(air.inbox(4).received.size(), 2u);
  EXPECT_EQ(air.inbox(5).received.size(), 2u);
}

TEST_F(Roaming, WhatWaitsForAStationThatHasLeftGoesAfterIt) {
  air.add({45, 0, 0}, {5, 0, 0});
  air.build();
  constexpr int kMessages = 1500;
  for (int i = 0; i < kMessages; ++i) {  // 15 every 20 ms: some wait all the time
    air.at(2s + i / 15 * 20ms, [this] { air.send(1, 3, kPayload); });
  }
  air.run(5s);
  ASSERT_EQ(associations.size(), 2u);
  ASSERT_EQ(associations[1].access_point, kRight);
  EXPECT_EQ(air.inbox(3).received.size(), kMessages);
  EXPECT_EQ(air.inbox(1).ended.size(), kMessages);
  EXPECT_GT(std::ranges::count_if(air.log.starts,
                                  [](const Log::Start& start) {
                                    return start.frame.type == FrameType::kData &&
                                           start.frame.transmitter == kRight;
                                  }),
            kMessages / 2);
}

TEST(HeardAccessPoints, LostOnesAreNotChosen) {
  const BssConfig config;
  HeardAccessPoints heard(config);
  heard.on_beacon(kLeft, hal::Dbm{-50}, 100ms, hal::Time{});
  heard.on_beacon(kRight, hal::Dbm{-60}, 100ms, hal::Time{} + 500ms);
  EXPECT_EQ(heard.strongest(hal::Time{} + 999ms), kLeft);
  EXPECT_EQ(heard.strongest(hal::Time{} + 1s), kRight);
  EXPECT_EQ(heard.strongest(hal::Time{} + 1500ms), std::nullopt);
}

TEST(HeardAccessPoints, BetterIsMoreThanTheHysteresis) {
  BssConfig config;
  config.hysteresis = hal::Decibels{4};
  config.beacon_weight = 0.5;
  HeardAccessPoints heard(config);
  heard.on_beacon(kLeft, hal::Dbm{-60}, 100ms, hal::Time{});
  heard.on_beacon(kRight, hal::Dbm{-60}, 100ms, hal::Time{});
  heard.on_beacon(kRight, hal::Dbm{-52}, 100ms, hal::Time{});  // mean -56
  EXPECT_EQ(heard.better_than(kLeft, hal::Time{}), std::nullopt);
  heard.on_beacon(kRight, hal::Dbm{-55}, 100ms, hal::Time{});  // mean -55.5
  EXPECT_EQ(heard.better_than(kLeft, hal::Time{}), kRight);
  EXPECT_EQ(heard.better_than(kRight, hal::Time{}), std::nullopt);
}

}  // namespace
}  // namespace sim::radio::test
