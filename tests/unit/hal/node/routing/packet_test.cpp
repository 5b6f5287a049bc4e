#include "hal/node/routing/packet.h"

#include <gtest/gtest.h>

#include <limits>

#include "hal/types/random.h"

namespace hal::node::routing {
namespace {

ForwardAnt forward_ant() {
  return {.header = {"help", AgentId{1}, AgentId{9}, 7},
          .started = time_from_ns(123456789),
          .path = {AgentId{1}, AgentId{300}},
          .way = {.hops = 1, .delay = Duration{5}, .min_snr_db = -1.5, .energy = 0.25}};
}

BackwardAnt backward_ant() {
  return {.header = {"help", AgentId{9}, AgentId{1}, 7},
          .path = {AgentId{1}, AgentId{2}, AgentId{3}},
          .position = 1,
          .way = {.hops = 1, .delay = Duration{5}, .min_snr_db = 3, .energy = 1}};
}

Data data() {
  return {.header = {"help", AgentId{1}, AgentId{9}, 8},
          .id = 70000,
          .transmissions = 3,
          .payload = {1, 2, 3}};
}

TEST(Packet, EveryKindSurvivesTheRoundTrip) {
  EXPECT_EQ(parse(encode(forward_ant())), Packet{forward_ant()});
  EXPECT_EQ(parse(encode(backward_ant())), Packet{backward_ant()});
  EXPECT_EQ(parse(encode(data())), Packet{data()});
}

TEST(Packet, DataIsLaidOutAsDocumented) {
  const Bytes expected = {0x13, 4,    'h',  'e',  'l', 'p',  // version 1, kind 3; topic
                          0,    1,    0,    9,               // source, destination
                          0,    0,    0,    8,               // sequence
                          0,    0x01, 0x11, 0x70,            // message id 70000
                          3,    1,    2,    3};              // transmissions, payload
  EXPECT_EQ(encode(data()), expected);
}

TEST(Packet, DataWithAPriorityHasAKindOfItsOwnAndOneOctetMore) {
  Data urgent = data();
  urgent.priority = Priority::kVoice;
  const Bytes expected = {0x1e, 4,    'h',  'e',  'l', 'p',  // version 1, kind 14; topic
                          0,    1,    0,    9,               // source, destination
                          0,    0,    0,    8,               // sequence
                          6,                                 // priority
                          0,    0x01, 0x11, 0x70,            // message id 70000
                          3,    1,    2,    3};              // transmissions, payload
  EXPECT_EQ(encode(urgent), expected);
  for (std::uint8_t number = 0; number <= kHighestPriority; ++number) {
    urgent.priority = Priority{number};
    EXPECT_EQ(parse(encode(urgent)), Packet{urgent}) << int{number};
  }
  constexpr std::size_t kPlace = 14;
  for (const std::uint8_t wrong : Bytes{0, 8, 255}) {
    Bytes frame = expected;
    frame[kPlace] = wrong;
    EXPECT_FALSE(parse(frame)) << int{wrong};
  }
}

TEST(Packet, FloodAndEmptyPayloadAreAllowed) {
  Data flood = data();
  flood.header.destination = kEveryone;
  flood.payload.clear();
  EXPECT_EQ(parse(encode(flood)), Packet{flood});
}

TEST(Packet, LongestTopicAndPayloadFitOneMsdu) {
  Data longest = data();
  longest.header.topic.assign(kMaxTopic, 'x');
  longest.payload.assign(kMaxPayload, 0xff);
  const Bytes frame = encode(longest);
  EXPECT_LE(frame.size(), 2304u);  // IEEE Std 802.11-2016, 9.2.4.7
  EXPECT_EQ(parse(frame), Packet{longest});
}

TEST(Packet, LongestPathFitsOneMsdu) {
  ForwardAnt ant = forward_ant();
  ant.header.topic.assign(kMaxTopic, 'x');
  ant.header.destination = AgentId{1000};
  ant.path.clear();
  for (std::uint16_t i = 1; i <= kMaxPath; ++i) ant.path.push_back(AgentId{i});
  ant.way.hops = kMaxPath - 1;
  const Bytes frame = encode(ant);
  EXPECT_LE(frame.size(), 2304u);
  EXPECT_EQ(parse(frame), Packet{ant});
}

TEST(Packet, EveryTruncationOfAnAntIsRefused) {
  for (const Packet& packet : {Packet{forward_ant()}, Packet{backward_ant()}}) {
    const Bytes frame = encode(packet);
    for (std::size_t size = 0; size < frame.size(); ++size) {
      EXPECT_FALSE(parse(std::span(frame).first(size))) << size << " of " << frame.size();
    }
  }
}

TEST(Packet, DataIsRefusedWhenItsHeaderIsCut) {
  const Bytes frame = encode(data());
  for (std::size_t size = 0; size < frame.size() - data().payload.size(); ++size) {
    EXPECT_FALSE(parse(std::span(frame).first(size))) << size;
  }
}

TEST(Packet, OctetsAfterAnAntAreRefused) {
  Bytes frame = encode(forward_ant());
  frame.push_back(0);
  EXPECT_FALSE(parse(frame));
}

template <class P, class Change>
bool is_refused(P packet, Change change) {
  change(packet);
  return !parse(encode(packet));
}

TEST(Packet, HeaderOutOfRangeIsRefused) {
  EXPECT_TRUE(is_refused(data(), [](Data& d) { d.header.source = kEveryone; }));
  EXPECT_TRUE(is_refused(data(), [](Data& d) { d.header.source = kNeighbours; }));
  EXPECT_TRUE(is_refused(data(), [](Data& d) {
    d.header.destination = kNeighbours;
    d.transmissions = 2;
  })) << "nobody repeats what goes to neighbours";
  EXPECT_TRUE(is_refused(data(), [](Data& d) { d.header.destination = d.header.source; }));
  EXPECT_TRUE(is_refused(data(), [](Data& d) { d.id = 0; }));
  EXPECT_TRUE(is_refused(data(), [](Data& d) { d.transmissions = 0; }));
  EXPECT_TRUE(is_refused(data(), [](Data& d) { d.payload.resize(kMaxPayload + 1); }));
  EXPECT_TRUE(is_refused(forward_ant(), [](ForwardAnt& a) { a.header.destination = kEveryone; }));
}

TEST(Packet, WrongVersionKindOrTopicLengthIsRefused) {
  Bytes frame = encode(data());
  frame[0] = 0x23;
  EXPECT_FALSE(parse(frame));
  frame[0] = 0x14;
  EXPECT_FALSE(parse(frame));
  frame = encode(data());
  frame[1] = 0;
  EXPECT_FALSE(parse(frame));
  frame[1] = kMaxTopic + 1;
  frame.resize(200, 'x');
  EXPECT_FALSE(parse(frame));
}

TEST(Packet, AntWithImpossiblePathIsRefused) {
  EXPECT_TRUE(is_refused(forward_ant(), [](ForwardAnt& a) { a.path[0] = AgentId{2}; }));
  EXPECT_TRUE(is_refused(forward_ant(), [](ForwardAnt& a) { a.path[1] = AgentId{1}; }));
  EXPECT_TRUE(is_refused(forward_ant(), [](ForwardAnt& a) { a.path[1] = AgentId{9}; }));
  EXPECT_TRUE(is_refused(forward_ant(), [](ForwardAnt& a) { a.path[1] = kEveryone; }));
  EXPECT_TRUE(is_refused(forward_ant(), [](ForwardAnt& a) { a.path.clear(); }));
  EXPECT_TRUE(is_refused(forward_ant(), [](ForwardAnt& a) { a.way.hops = 2; }));
  EXPECT_TRUE(is_refused(backward_ant(), [](BackwardAnt& a) { a.position = 3; }));
  EXPECT_TRUE(is_refused(backward_ant(), [](BackwardAnt& a) { a.position = 2; }));
  EXPECT_TRUE(is_refused(backward_ant(), [](BackwardAnt& a) { a.path[0] = AgentId{9}; }));
}

TEST(Packet, StatisticsThatAreNoNumbersAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(is_refused(forward_ant(), [&](ForwardAnt& a) { a.way.min_snr_db = nan; }));
  EXPECT_TRUE(is_refused(forward_ant(), [&](ForwardAnt& a) { a.way.energy = nan; }));
  EXPECT_TRUE(is_refused(forward_ant(), [&](ForwardAnt& a) { a.way.energy = infinity; }));
  EXPECT_TRUE(is_refused(forward_ant(), [&](ForwardAnt& a) { a.way.energy = -1; }));
  EXPECT_TRUE(is_refused(forward_ant(), [&](ForwardAnt& a) { a.way.delay = Duration{-1}; }));
  EXPECT_TRUE(is_refused(forward_ant(), [&](ForwardAnt& a) { a.way.delay = Duration::max(); }));
  EXPECT_TRUE(is_refused(forward_ant(), [&](ForwardAnt& a) { a.started = time_from_ns(-1); }));
}

// Whatever gets through the parser is a packet that encodes to the same bytes: it holds nothing
// that the frame did not say.
TEST(Packet, DamagedFramesAreRefusedOrMeanWhatTheySay) {
  RandomStream random(1, "packet fuzz");
  const std::vector<Bytes> frames = {encode(forward_ant()), encode(backward_ant()), encode(data())};
  int refused = 0;
  for (int round = 0; round < 30000; ++round) {
    Bytes frame = frames[random.below(3)];
    for (std::uint32_t flips = 1 + random.below(4); flips > 0; --flips) {
      const auto size = static_cast<std::uint32_t>(frame.size());
      frame[random.below(size)] = static_cast<std::uint8_t>(random.below(256));
    }
    if (random.below(4) == 0) frame.resize(random.below(80));
    const auto packet = parse(frame);
    if (packet) {
      EXPECT_EQ(encode(*packet), frame);
    } else {
      ++refused;
    }
  }
  EXPECT_GT(refused, 3000);   // of 30000: the damage reaches the rules …
  EXPECT_LT(refused, 29000);  // … and not every byte is under a rule
}

}  // namespace
}  // namespace hal::node::routing
