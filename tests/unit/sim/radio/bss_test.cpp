#include "tests/unit/sim/radio/bss.h"

#include <algorithm>

namespace sim::radio::test {
namespace {

using hal::Verdict;

/// One access point, 1, and stations around it.
class Bss : public BssTest {};

TEST_F(Bss, BeaconsComeEvery102400MicrosecondsWhetherThereAreStationsOrNot) {
  build({{0, 0, 0}});
  air.run(1s);
  ASSERT_EQ(air.log.starts.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(start_of(i), i * 102400us);
    EXPECT_EQ(air.log.starts[i].frame.type, FrameType::kBeacon);
    EXPECT_EQ(air.log.starts[i].frame.rate, hal::BitsPerSecond{1e6});
    EXPECT_EQ(air.log.starts[i].frame.address3, hal::AgentId{1});
  }
}

// 11.3.4 and 11.3.5: authentication of two frames, association of two, each acknowledged.
TEST_F(Bss, StationAssociatesAfterItsScan) {
  build({{0, 0, 0}, {50, 0, 0}});
  air.run(300ms);
  EXPECT_EQ(air.log.story(),
            "BEACON1 BEACON1 AUTH2 ACK1 AUTH1 ACK2 ASSOC?2 ACK1 ASSOC1 ACK2 BEACON1");
  EXPECT_GE(start_of(2), 120ms);
  ASSERT_EQ(associations.size(), 1u);
  EXPECT_EQ(associations[0].station, hal::AgentId{2});
  EXPECT_EQ(associations[0].access_point, hal::AgentId{1});
  EXPECT_GT(associations[0].at, hal::Time{} + 120ms);
  EXPECT_LT(associations[0].at, hal::Time{} + 160ms);
}

TEST_F(Bss, TwelveStationsAssociateAtOnce) {
  std::vector<hal::Vec3> places{{0, 0, 0}};
  for (int i = 0; i < 12; ++i) places.push_back({10.0 + i, 5, 0});
  build(places);
  air.run(500ms);
  EXPECT_EQ(associations.size(), 12u);
  for (std::uint16_t station = 2; station <= 13; ++station) air.send(station, 1, kPayload);
  air.run(600ms);
  EXPECT_EQ(air.inbox(1).received.size(), 12u);
}

// Each scan is longer than the scan time, by a part of its own.
TEST_F(Bss, StationsThatStartTogetherAskApart) {
  std::vector<hal::Vec3> places{{0, 0, 0}};
  for (int i = 0; i < 7; ++i) places.push_back({10.0 + i, 5, 0});
  build(places);
  air.run(400ms);
  EXPECT_EQ(associations.size(), 7u);
  int asked = 0;
  for (const Log::Start& start : air.log.starts) {
    if (start.frame.type != FrameType::kAuthentication || start.frame.transmitter.value == 1) {
      continue;
    }
    EXPECT_GT(start.at, hal::Time{} + 120ms);
    ++asked;
  }
  EXPECT_EQ(asked, 7);  // none twice
}

// So many cannot be answered in time: those that were not must not all come back together.
TEST_F(Bss, CrowdAssociatesAsThoseThatFailSpreadOut) {
  std::vector<hal::Vec3> places{{0, 0, 0}};
  for (int i = 0; i < 200; ++i) places.push_back({10.0 + 0.1 * i, 5, 0});
  build(places);
  air.run(6s);
  EXPECT_EQ(associations.size(), 200u);
}

TEST_F(Bss, RequestsWaitForTheAssociation) {
  build({{0, 0, 0}, {50, 0, 0}});
  air.send(2, 1, kPayload, 7);
  air.run(119ms);
  EXPECT_TRUE(air.inbox(2).ended.empty());
  EXPECT_EQ(std::ranges::count(types(), FrameType::kData), 0);
  air.run(300ms);
  ASSERT_EQ(air.inbox(2).ended.size(), 1u);
  EXPECT_EQ(air.inbox(2).ended[0].tag, 7u);
  EXPECT_EQ(air.inbox(2).ended[0].verdict, Verdict::kDelivered);
  ASSERT_EQ(air.inbox(1).received.size(), 1u);
  EXPECT_EQ(air.inbox(1).received[0].indication.source, hal::AgentId{2});
}

TEST_F(Bss, FramesBetweenStationsGoThroughTheAccessPoint) {
  build({{0, 0, 0}, {50, 0, 0}, {-50, 0, 0}});
  air.run(200ms);
  forget();
  air.send(2, 3, kPayload);
  air.run(204ms);
  ASSERT_EQ(air.log.story(), "DATA2 ACK1 DATA1 ACK3");
  const Frame& up = air.log.starts[0].frame;
  EXPECT_EQ(up.ds, Ds::kTo);
  EXPECT_EQ(up.receiver, hal::AgentId{1});
  EXPECT_EQ(up.address3, hal::AgentId{3});
  const Frame& down = air.log.starts[2].frame;
  EXPECT_EQ(down.ds, Ds::kFrom);
  EXPECT_EQ(down.receiver, hal::AgentId{3});
  EXPECT_EQ(down.address3, hal::AgentId{2});
  ASSERT_EQ(air.inbox(3).received.size(), 1u);
  EXPECT_EQ(air.inbox(3).received[0].indication.source, hal::AgentId{2});
  EXPECT_EQ(air.inbox(3).received[0].indication.destination, hal::AgentId{3});
  EXPECT_TRUE(air.inbox(1).received.empty());
}

TEST_F(Bss, GroupFramesReachEveryoneButTheirSource) {
  build({{0, 0, 0}, {50, 0, 0}, {-50, 0, 0}, {0, 50, 0}});
  air.run(200ms);
  forget();
  air.broadcast(2, kPayload);
  air.run(204ms);
  EXPECT_EQ(air.log.story(), "DATA2 ACK1 DATA1");
  for (const std::uint16_t station : std::vector<std::uint16_t>{1, 3, 4}) {
    ASSERT_EQ(air.inbox(station).received.size(), 1u) << station;
    EXPECT_EQ(air.inbox(station).received[0].indication.source, hal::AgentId{2});
    EXPECT_EQ(air.inbox(station).received[0].indication.destination, hal::kEveryone);
  }
  EXPECT_TRUE(air.inbox(2).received.empty());
}

TEST_F(Bss, AccessPointTalksToItsStationsAndNobodyElse) {
  build({{0, 0, 0}, {50, 0, 0}});
  air.run(200ms);
  air.send(1, 2, kPayload, 1);
  air.send(1, 9, kPayload, 2);
  air.broadcast(1, kPayload);
  air.run(210ms);
  EXPECT_EQ(air.inbox(2).received.size(), 2u);
  ASSERT_EQ(air.inbox(1).ended.size(), 3u);
  EXPECT_EQ(verdict_of(1, 1), Verdict::kDelivered);
  EXPECT_EQ(verdict_of(1, 2), Verdict::kNoRoute);
}

TEST_F(Bss, WhatCannotBePassedOnIsTold) {
  build({{0, 0, 0}, {50, 0, 0}, {-50, 0, 0}});
  air.run(200ms);
  air.sap(3).set_radio(false);
  air.send(2, 3, kPayload);  // associated, but silent
  air.send(2, 9, kPayload);  // nobody
  air.run(300ms);
  EXPECT_EQ(air.inbox(2).ended.size(), 2u);
  ASSERT_EQ(relays_lost.size(), 2u);
  std::ranges::sort(relays_lost);
  EXPECT_EQ(relays_lost[0], Verdict::kRetryLimit);
  EXPECT_EQ(relays_lost[1], Verdict::kNoRoute);
}

TEST_F(Bss, EveryRequestEndsOnceWhateverIsSwitchedOff) {
  dcf().contention.queue_limit = 5;
  build({{0, 0, 0}, {50, 0, 0}});
  for (std::uint64_t tag = 1; tag <= 7; ++tag) air.send(2, 1, kPayload, tag);  // not associated
  air.at(50ms, [this] { air.sap(2).set_radio(false); });
  air.at(60ms, [this] { air.send(2, 1, kPayload, 8); });
  air.at(70ms, [this] { air.sap(2).set_radio(true); });
  air.at(80ms, [this] { air.send(2, 1, kPayload, 9); });
  air.run(1s);
  for (std::uint64_t tag = 1; tag <= 9; ++tag) {
    const auto expected = tag <= 5   ? Verdict::kRadioOff
                          : tag <= 7 ? Verdict::kQueueFull
                          : tag <= 8 ? Verdict::kRadioOff
                                     : Verdict::kDelivered;
    EXPECT_EQ(verdict_of(2, tag), expected) << tag;
  }
  EXPECT_EQ(air.inbox(2).ended.size(), 9u);
}

// The access point forgets its stations while it is off, shorter than they take to notice.
TEST_F(Bss, AccessPointThatForgotAStationSendsItAway) {
  build({{0, 0, 0}, {50, 0, 0}});
  air.at(200ms, [this] { air.sap(1).set_radio(false); });
  air.at(210ms, [this] { air.sap(1).set_radio(true); });
  air.at(250ms, [this] { air.send(2, 1, kPayload); });
  air.at(600ms, [this] { air.send(2, 1, kPayload); });
  air.run(1s);
  EXPECT_EQ(std::ranges::count(types(), FrameType::kDeauthentication), 1);
  ASSERT_EQ(associations.size(), 3u);
  EXPECT_EQ(associations[1].access_point, std::nullopt);
  EXPECT_EQ(associations[2].access_point, hal::AgentId{1});
  EXPECT_EQ(air.inbox(1).received.size(), 1u);
  EXPECT_EQ(air.inbox(2).ended.size(), 2u);
}

TEST_F(Bss, TenMissedBeaconsAreALoss) {
  build({{0, 0, 0}, {50, 0, 0}});
  air.at(310ms, [this] { air.sap(1).set_radio(false); });  // last beacon: 307.2 ms
  air.run(3s);
  ASSERT_EQ(associations.size(), 2u);
  EXPECT_EQ(associations[1].access_point, std::nullopt);
  // From the last one's end.
  const hal::Duration since = associations[1].at.time_since_epoch() - 307'200us;
  EXPECT_GT(since, 1024ms);
  EXPECT_LT(since, 1026ms);
}

TEST_F(Bss, AdHocStationsInTheSameAirHearNothingOfIt) {
  air.add({0, 0, 0});
  air.add({50, 0, 0});
  air.add({0, 50, 0});
  air.add({0, 55, 0});
  dcf().bss.access_points = {"s1"};
  air.set_access_points(3, std::vector<std::string>{});
  air.set_access_points(4, std::vector<std::string>{});
  air.build();
  air.at(200ms, [this] { air.broadcast(2, kPayload); });
  air.at(250ms, [this] { air.broadcast(3, kPayload); });
  air.run(300ms);
  EXPECT_EQ(air.inbox(1).received.size(), 1u);
  EXPECT_EQ(air.inbox(2).received.size(), 0u);
  EXPECT_EQ(air.inbox(3).received.size(), 0u);
  EXPECT_EQ(air.inbox(4).received.size(), 1u);
}

TEST_F(Bss, BeaconSaysWhatTheNetworkIs) {
  dcf().bss.ssid = "field";
  build({{0, 0, 0}});
  air.run(110ms);
  const auto beacon = decode_beacon(*air.log.starts.at(1).frame.payload);
  ASSERT_TRUE(beacon.has_value());
  EXPECT_EQ(beacon->interval, 102400us);
  EXPECT_EQ(beacon->bss.ssid, "field");
  EXPECT_EQ(beacon->bss.rates, (std::vector<std::uint8_t>{0x82, 0x04, 0x0b, 0x16}));
  EXPECT_EQ(beacon->bss.channel, 1);
  EXPECT_FALSE(beacon->bss.erp);
  // Preamble, PLCP header and 24 bytes at 1 Mb/s before it.
  EXPECT_EQ(beacon->timestamp, hal::Time{} + 102400us + 192us + 192us);
}

TEST_F(Bss, BeaconOf80211gHasTheErpElement) {
  air.config = profile_defaults(Profile::kIeee80211g);
  build({{0, 0, 0}});
  air.run(10ms);
  const auto beacon = decode_beacon(*air.log.starts.at(0).frame.payload);
  ASSERT_TRUE(beacon.has_value());
  EXPECT_TRUE(beacon->bss.erp);
  EXPECT_FALSE(beacon->bss.use_protection);
  EXPECT_EQ(beacon->bss.rates.size(), 12u);
}

TEST_F(Bss, StationWithoutOfdmIsServedAndItsBeaconsAskForProtection) {
  air.config = profile_defaults(Profile::kIeee80211g);
  air.add({0, 0, 0});
  air.add({20, 0, 0});
  air.add({0, 20, 0});
  air.station_config(3).standard = Standard::kIeee80211b;
  dcf().bss.access_points = {"s1"};
  air.build();
  air.run(210ms);
  EXPECT_EQ(associations.size(), 2u);
  EXPECT_TRUE(decode_beacon(*air.log.starts.at(0).frame.payload)->bss.use_protection);
  forget();
  air.send(2, 3, kPayload);
  air.send(3, 2, kPayload);
  air.run(300ms);
  EXPECT_EQ(air.inbox(2).received.size(), 1u);
  EXPECT_EQ(air.inbox(3).received.size(), 1u);
  for (const Log::Start& start : air.log.starts) {  // what goes to 3 is in a mode that it knows
    if (start.frame.receiver != hal::AgentId{3} || start.frame.type != FrameType::kData) continue;
    EXPECT_EQ(start.frame.mode->modulation_class(), ModulationClass::kDsss);
  }
}

TEST_F(Bss, LifetimeCountsFromTheRequestEvenWithoutAnAccessPoint) {
  dcf().msdu_lifetime = 50ms;
  build({{0, 0, 0}, {50, 0, 0}});
  air.at(20ms, [this] { air.send(2, 1, kPayload, 1); });
  air.at(100ms, [this] { air.send(2, 1, kPayload, 2); });
  air.run(300ms);
  EXPECT_EQ(verdict_of(2, 1), Verdict::kExpired);
  EXPECT_EQ(verdict_of(2, 2), Verdict::kDelivered);  // associated after 160 ms at most
  EXPECT_EQ(air.inbox(2).ended.at(0).at, hal::Time{} + 100ms);
}

TEST_F(Bss, AccessPointsOfOneNetworkMayHaveTheirOwnChannels) {
  for (const hal::Vec3& place : {hal::Vec3{0, 0, 0}, {5, 0, 0}, {10, 0, 0}, {15, 0, 0}}) {
    air.add(place);
  }
  for (const std::uint16_t station : std::vector<std::uint16_t>{2, 4}) {
    air.station_config(station).channel = 6;
  }
  dcf().bss.access_points = {"s1", "s2"};
  air.build();
  air.run(210ms);
  ASSERT_EQ(associations.size(), 2u);
  for (const auto& association : associations) {
    EXPECT_EQ(association.access_point->value + 2, association.station.value);
  }
  EXPECT_EQ(decode_beacon(*air.log.starts.at(1).frame.payload)->bss.channel, 6);
  forget();
  air.send(3, 4, kPayload);
  air.run(220ms);
  EXPECT_EQ(air.log.story(), "DATA3 DATA2 ACK1 ACK4");  // the other channel is free
}

TEST_F(Bss, AccessPointThatIsNoStationIsRefused) {
  air.add({0, 0, 0});
  dcf().bss.access_points = {"nobody"};
  EXPECT_THROW(air.build(), std::invalid_argument);
}

}  // namespace
}  // namespace sim::radio::test
