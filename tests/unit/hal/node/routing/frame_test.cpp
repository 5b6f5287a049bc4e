#include "hal/node/routing/frame.h"

#include <gtest/gtest.h>

#include "hal/node/routing/router.h"
#include "hal/types/random.h"
#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::test {
namespace {

Data data() {
  return {.header = {"help", AgentId{1}, AgentId{9}, 8},
          .id = 70000,
          .transmissions = 3,
          .payload = {1, 2, 3}};
}
ForwardAnt forward_ant() {
  return {.header = {"help", AgentId{1}, AgentId{9}, 7},
          .started = time_from_ns(123456789),
          .path = {AgentId{1}},
          .way = {}};
}
BackwardAnt backward_ant() {
  return {.header = {"help", AgentId{9}, AgentId{1}, 7},
          .path = {AgentId{1}, AgentId{2}},
          .position = 1,
          .way = {}};
}

TEST(Frame, ABarePacketKeepsItsBytes) {
  EXPECT_EQ(parse_frame(encode(data())), Frame{Packet{data()}});
  EXPECT_EQ(parse_frame(encode(forward_ant())), Frame{Packet{forward_ant()}});
}

TEST(Frame, EveryKindSurvivesTheRoundTrip) {
  EXPECT_EQ(parse_frame(encode_numbered(70000, encode(data()))), (Frame{Numbered{70000, data()}}));
  EXPECT_EQ(parse_frame(encode_numbered(0, encode(backward_ant()))),
            (Frame{Numbered{0, backward_ant()}}));
  EXPECT_EQ(parse_frame(encode(HopAck{70000})), Frame{HopAck{70000}});
  EXPECT_EQ(parse_frame(encode(Hello{1s})), Frame{Hello{1s}});
  EXPECT_EQ(parse_frame(encode(Hello{kMaxHelloPeriod})), Frame{Hello{kMaxHelloPeriod}});
}

TEST(Frame, IsLaidOutAsDocumented) {
  EXPECT_EQ(encode_numbered(0x01020304, {0xaa, 0xbb}), (Bytes{0x14, 1, 2, 3, 4, 0xaa, 0xbb}));
  EXPECT_EQ(encode(HopAck{0x01020304}), (Bytes{0x15, 1, 2, 3, 4}));
  EXPECT_EQ(encode(Hello{1s}), (Bytes{0x16, 0, 0, 0x03, 0xe8}));
}

// Rounded down, a listener would give up too early.
TEST(Frame, AHelloRoundsItsPeriodUp) {
  EXPECT_EQ(parse_frame(encode(Hello{1500us})), Frame{Hello{2ms}});
}

TEST(Frame, OnlyAPacketForOneNeighbourIsNumbered) {
  Data flood = data();
  flood.header.destination = kEveryone;
  EXPECT_FALSE(parse_frame(encode_numbered(1, encode(flood))));
  EXPECT_FALSE(parse_frame(encode_numbered(1, encode(forward_ant()))));
  EXPECT_FALSE(parse_frame(encode_numbered(1, encode(HopAck{2}))));
  EXPECT_FALSE(parse_frame(encode_numbered(1, encode_numbered(2, encode(data())))));
  EXPECT_FALSE(parse_frame(encode_numbered(1, {})));
}

TEST(Frame, AHelloWithoutASensiblePeriodIsRefused) {
  EXPECT_FALSE(parse_frame(Bytes{0x16, 0, 0, 0, 0}));
  EXPECT_FALSE(parse_frame(Bytes{0x16, 0xff, 0xff, 0xff, 0xff}));
}

TEST(Frame, EveryTruncationAndEveryOctetTooManyIsRefused) {
  for (Bytes frame :
       {encode(HopAck{70000}), encode(Hello{1s}), encode_numbered(1, encode(backward_ant()))}) {
    for (std::size_t size = 0; size < frame.size(); ++size) {
      EXPECT_FALSE(parse_frame(std::span(frame).first(size))) << size << " of " << frame.size();
    }
    frame.push_back(0);
    EXPECT_FALSE(parse_frame(frame));
  }
}

Bytes encode_again(const Frame& frame) {
  if (const auto* ack = std::get_if<HopAck>(&frame)) return encode(*ack);
  if (const auto* hello = std::get_if<Hello>(&frame)) return encode(*hello);
  const Bytes packet = encode(*packet_in(frame));
  const auto* numbered = std::get_if<Numbered>(&frame);
  return numbered ? encode_numbered(numbered->number, packet) : packet;
}

/// A frame with up to four octets changed, and cut short one time in four.
Bytes damaged(Bytes frame, RandomStream& random) {
  for (std::uint32_t changes = random.below(5); changes > 0; --changes) {
    const auto size = static_cast<std::uint32_t>(frame.size());
    frame[random.below(size)] = static_cast<std::uint8_t>(random.below(256));
  }
  if (random.below(4) == 0) frame.resize(random.below(static_cast<std::uint32_t>(frame.size())));
  return frame;
}

std::vector<Bytes> one_of_each() {
  return {encode(data()),
          encode(forward_ant()),
          encode_numbered(1, encode(backward_ant())),
          encode_numbered(2, encode(data())),
          encode(HopAck{1}),
          encode(Hello{1s})};
}

// Whatever gets through the parser encodes to the same bytes: it holds nothing that the frame did
// not say.
TEST(Frame, DamagedFramesAreRefusedOrMeanWhatTheySay) {
  RandomStream random(1, "frame fuzz");
  const auto frames = one_of_each();
  int refused = 0;
  for (int round = 0; round < 60000; ++round) {
    const Bytes bytes = damaged(frames[random.below(6)], random);
    const auto frame = parse_frame(bytes);
    refused += !frame;
    if (frame) {
      ASSERT_EQ(encode_again(*frame), bytes);
    }
  }
  EXPECT_GT(refused, 6000);   // of 60000: the damage reaches the rules …
  EXPECT_LT(refused, 54000);  // … and not every octet is under a rule
}

// A daemon's socket hears whatever its network carries, from whatever address.
TEST(Frame, ARouterUnderFireDropsCountsAndGoesOn) {
  Network network(2, {}, 1, Network::kNothing);
  connect_chain(network);
  RandomStream random(2, "router fuzz");
  const auto frames = one_of_each();
  TestNode& target = network.node(1);
  for (int round = 0; round < 20000; ++round) {
    Bytes bytes = damaged(frames[random.below(6)], random);
    if (random.below(3) == 0) {
      for (auto& octet : bytes) octet = static_cast<std::uint8_t>(random.below(256));
    }
    const AgentId from{static_cast<std::uint16_t>(random.below(65536))};
    const auto before = target.router->malformed_frames();
    target.router->on_frame({.from = from}, bytes);
    if (!parse_frame(bytes)) {
      ASSERT_EQ(target.router->malformed_frames(), before + 1);
    }
  }
  network.run(60s);
  network.node(2).messages.clear();  // forged well enough to be passed on
  const MessageId message = network.send(1, 2);
  network.run(10s);
  ASSERT_EQ(network.node(2).messages.size(), 1u);
  EXPECT_EQ(network.node(2).messages[0].id, message);
}

TEST(Frame, NobodyIsTheirOwnNeighbourOrEveryone) {
  Network network(2, {}, 1, Network::kNothing);
  TestNode& node = network.node(1);
  node.router->on_frame({.from = id(1)}, encode(Hello{1s}));
  node.router->on_frame({.from = kEveryone}, encode(Hello{1s}));
  EXPECT_EQ(node.router->malformed_frames(), 2u);
  EXPECT_TRUE(node.heard.empty());
}

}  // namespace
}  // namespace hal::node::routing::test
