#include "sim/air/interface.h"

#include <gtest/gtest.h>

#include <array>

#include "hal/types/random.h"
#include "tests/unit/sim/radio/air.h"

namespace sim::air {
namespace {

using namespace std::chrono_literals;
using radio::test::Air;
using Bytes = std::vector<std::uint8_t>;

constexpr std::array<std::uint8_t, 6> kMac1{2, 0, 0, 0, 0, 1}, kMac2{2, 0, 0, 0, 0, 2},
    kMdns{0x01, 0x00, 0x5e, 0, 0, 0xfb}, kAllNodes{0x33, 0x33, 0, 0, 0, 1},
    kAll{0xff, 0xff, 0xff, 0xff, 0xff, 0xff};

Bytes frame(const std::array<std::uint8_t, 6>& to, const std::array<std::uint8_t, 6>& from,
            std::uint16_t ethertype, const Bytes& payload) {
  Bytes bytes(to.begin(), to.end());
  bytes.insert(bytes.end(), from.begin(), from.end());
  bytes.push_back(static_cast<std::uint8_t>(ethertype >> 8));
  bytes.push_back(static_cast<std::uint8_t>(ethertype & 0xff));
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}

/// What the interfaces told.
class Told final : public InterfaceListener {
 public:
  struct Left {
    hal::AgentId agent;
    Bytes ethernet;
    bool operator==(const Left&) const = default;
  };
  void on_entered(hal::AgentId, const radio::MacRequest& request) override {
    entered.push_back(request);
  }
  void on_left(hal::AgentId agent, const radio::MacIndication&,
               std::span<const std::uint8_t> ethernet) override {
    left.push_back({agent, Bytes(ethernet.begin(), ethernet.end())});
  }
  void on_refused(hal::AgentId, Refusal refusal, std::size_t) override {
    ++refused[static_cast<std::size_t>(refusal)];
  }
  void on_ended(hal::AgentId) override { ++ended; }

  std::vector<radio::MacRequest> entered;
  std::vector<Left> left;
  std::array<int, kRefusals> refused{};
  int ended = 0;
};

/// Three stations next to each other, each with an interface.
class InterfaceTest : public testing::Test {
 protected:
  explicit InterfaceTest(radio::Profile profile = radio::Profile::kIdeal)
      : InterfaceTest(radio::profile_defaults(profile)) {}
  explicit InterfaceTest(const radio::RadioConfig& config) : air(config) {
    for (const double x : {0.0, 10.0, 20.0}) air.add({x, 0, 1});
    air.build();
    for (std::uint16_t i = 1; i <= 3; ++i) {
      interfaces.push_back(std::make_unique<Interface>(hal::AgentId{i}, air.sap(i), told));
    }
  }
  void send(std::size_t station, const Bytes& ethernet) {
    interfaces.at(station - 1)->send(ethernet);
    run();
  }
  void run() {
    while (air.events.next_time()) air.events.run_next();
  }

  Air air;
  Told told;
  std::vector<std::unique_ptr<Interface>> interfaces;
};

TEST_F(InterfaceTest, FramesComeOutAsTheyWentIn) {
  const Bytes one = frame(kMac2, kMac1, 0x0800, {1, 2, 3});
  send(1, one);
  EXPECT_EQ(told.left, (std::vector<Told::Left>{{hal::AgentId{2}, one}}));
  EXPECT_EQ(told.ended, 1);
}

TEST_F(InterfaceTest, GroupsStayWhatTheyAreAndDoNotComeBack) {
  std::vector<Told::Left> expected;
  for (const auto& [to, ethertype] :
       std::vector<std::pair<std::array<std::uint8_t, 6>, std::uint16_t>>{
           {kMdns, 0x0800}, {kAllNodes, 0x86dd}, {kAll, 0x0806}}) {
    const Bytes one = frame(to, kMac2, ethertype, {9, 8, 7});
    send(2, one);
    expected.push_back({hal::AgentId{1}, one});
    expected.push_back({hal::AgentId{3}, one});
  }
  EXPECT_EQ(told.left, expected);
}

TEST_F(InterfaceTest, EachRequestHasATagOfItsOwnAndThePayloadBehindTheHeader) {
  send(1, frame(kMac2, kMac1, 0x86dd, {5}));
  send(1, frame(kMdns, kMac1, 0x0800, {6}));
  ASSERT_EQ(told.entered.size(), 2u);
  EXPECT_EQ(told.entered[0].destination, hal::AgentId{2});
  EXPECT_EQ(told.entered[0].ethertype, kEthertypeIpv6);
  EXPECT_EQ(*told.entered[0].payload, Bytes{5});
  EXPECT_EQ(told.entered[1].destination, hal::kEveryone);
  EXPECT_EQ(told.entered[1].group, 0x01005e0000fbu);
  EXPECT_NE(told.entered[0].tag, told.entered[1].tag);
}

TEST_F(InterfaceTest, WhatNoStationCanSendIsRefusedForItsReason) {
  const auto refused = [&](Refusal refusal) {
    return std::exchange(told.refused[static_cast<std::size_t>(refusal)], 0);
  };
  send(1, Bytes(13));
  EXPECT_EQ(refused(Refusal::kTooShort), 1);
  send(1, frame(kMac2, kMac1, 0x0800, Bytes(radio::kMaxMsdu + 1)));
  EXPECT_EQ(refused(Refusal::kTooLong), 1);
  for (const int ethertype : {0x0000, 0x0026, 0x05dc, 0x8100, 0x88b5, 0x88cc}) {
    send(1, frame(kMac2, kMac1, static_cast<std::uint16_t>(ethertype), {1}));
  }
  EXPECT_EQ(refused(Refusal::kEthertype), 6);
  send(1, frame(kMac2, {2, 0, 0, 0, 0, 3}, 0x0800, {1}));
  send(1, frame(kMac2, kMdns, 0x0800, {1}));
  EXPECT_EQ(refused(Refusal::kSource), 2);
  for (const std::array<std::uint8_t, 6>& to : {kMac1,
                                                {2, 0, 0, 0, 0, 0},
                                                {2, 0, 0, 0, 0xff, 0xff},
                                                {2, 0, 0, 0, 0xff, 0xfe},
                                                {0, 0x1b, 0x21, 1, 2, 3}}) {
    send(1, frame(to, kMac1, 0x0800, {1}));
  }
  EXPECT_EQ(refused(Refusal::kDestination), 5);
  EXPECT_TRUE(told.left.empty());
  EXPECT_TRUE(told.entered.empty());
  send(1, frame(kMac2, kMac1, 0x0800, Bytes(radio::kMaxMsdu)));
  EXPECT_EQ(told.left.size(), 1u);
}

TEST_F(InterfaceTest, AnUnknownStationIsSentToAndDoesNotAnswer) {
  send(1, frame({2, 0, 0, 0, 0, 77}, kMac1, 0x0800, {1}));
  EXPECT_EQ(told.entered.size(), 1u);
  EXPECT_EQ(told.ended, 1);
  EXPECT_TRUE(told.left.empty());
}

/// Garbage: half of it random throughout, half of it with one wrong octet in the header.
TEST_F(InterfaceTest, AMillionRandomFramesAreSentOrRefusedForAReason) {
  constexpr int kFrames = 1'000'000;
  hal::RandomStream random(1, "garbage");
  const Bytes good = frame(kMac2, kMac1, 0x0800, {});
  for (int i = 0; i < kFrames; ++i) {
    Bytes bytes(random.next() % (i % 64 == 0 ? 2400 : 80));
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.next());
    if (random.next() % 2 == 0 && !bytes.empty()) {
      const std::size_t wrong = random.next() % std::min(bytes.size(), good.size());
      const std::uint8_t instead = bytes[wrong];
      std::copy_n(good.begin(), std::min(good.size(), bytes.size()), bytes.begin());
      bytes[wrong] = instead;
    }
    interfaces[0]->send(bytes);
    run();
  }
  int refused = 0;
  for (const int count : told.refused) refused += count;
  EXPECT_EQ(refused + static_cast<int>(told.entered.size()), kFrames);
  EXPECT_EQ(told.ended, static_cast<int>(told.entered.size()));
  EXPECT_GT(told.entered.size(), 1000u);
  for (const int count : told.refused) EXPECT_GT(count, 100);
}

TEST_F(InterfaceTest, TcpIsNoticedInBothVersions) {
  Bytes packet(40);
  packet[9] = 17;
  send(1, frame(kMac2, kMac1, 0x0800, packet));
  packet[9] = 6;
  send(1, frame(kMac2, kMac1, 0x0806, packet));
  EXPECT_FALSE(interfaces[0]->has_seen_tcp());
  send(1, frame(kMac2, kMac1, 0x0800, packet));
  EXPECT_TRUE(interfaces[0]->has_seen_tcp());
  packet[6] = 6;
  send(2, frame(kMac1, kMac2, 0x86dd, packet));
  EXPECT_TRUE(interfaces[1]->has_seen_tcp());
}

/// With a medium, on which frames take time.
class WavesTest : public InterfaceTest {
 protected:
  WavesTest() : InterfaceTest(radio::Profile::kIeee80211b) {}
};

TEST_F(WavesTest, TheRoomIsWhatTheQueueStillTakes) {
  const std::size_t capacity = interfaces[0]->room();
  ASSERT_GT(capacity, 4u);
  const Bytes one = frame(kMac2, kMac1, 0x0800, Bytes(100));
  for (std::size_t sent = 0; sent < capacity + 2; ++sent) {
    EXPECT_EQ(interfaces[0]->room(), capacity - std::min(sent, capacity));
    interfaces[0]->send(one);
  }
  EXPECT_EQ(interfaces[1]->room(), capacity);
  run();
  EXPECT_EQ(interfaces[0]->room(), capacity);
  EXPECT_EQ(told.left.size(), capacity);
  EXPECT_EQ(told.ended, static_cast<int>(capacity + 2));
}

/// Station 1 is the access point.
class CellTest : public InterfaceTest {
 protected:
  CellTest() : InterfaceTest(with_access_point()) { air.run(2s); }

  static radio::RadioConfig with_access_point() {
    radio::RadioConfig config = radio::profile_defaults(radio::Profile::kIeee80211b);
    radio::dcf_of(config)->bss.access_points = {"s1"};
    return config;
  }
};

TEST_F(CellTest, FramesKeepTheirAddressesThroughAnAccessPoint) {
  const Bytes unicast = frame({2, 0, 0, 0, 0, 3}, kMac2, 0x0800, {1, 2});
  interfaces[1]->send(unicast);
  air.run(3s);
  EXPECT_EQ(told.left, (std::vector<Told::Left>{{hal::AgentId{3}, unicast}}));
  told.left.clear();
  const Bytes group = frame(kAllNodes, kMac2, 0x86dd, {3});
  interfaces[1]->send(group);
  air.run(4s);
  EXPECT_EQ(told.left,
            (std::vector<Told::Left>{{hal::AgentId{1}, group}, {hal::AgentId{3}, group}}));
}

}  // namespace
}  // namespace sim::air
