#include "hal/node/routing/hop_acknowledgement.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/hal/node/routing/test_network.h"

/// Routers over a link that says nothing about its frames. Hellos are rare here: see hello_test.
namespace hal::node::routing::test {
namespace {

const RoutingConfig kAcknowledging{.jitter_max = Duration::zero(),
                                   .ack_timeout = 50ms,
                                   .ack_attempts = 4,
                                   .hello_period = kMaxHelloPeriod};

Network silent_links(int nodes, RoutingConfig config = kAcknowledging) {
  return Network(nodes, config, 1, Network::kNothing);
}

bool is_ack(const SentFrame& frame) { return frame.bytes.front() == 0x15; }
bool is_data(const SentFrame& frame) {
  const auto parsed = parse_frame(frame.bytes);
  const Packet* packet = parsed ? packet_in(*parsed) : nullptr;
  return packet != nullptr && std::holds_alternative<Data>(*packet);
}

template <class Filter>
std::vector<SentFrame> sent(const Network& network, int from, Filter filter) {
  std::vector<SentFrame> found;
  for (const SentFrame& frame : network.sent) {
    if (frame.from == id(from) && filter(frame)) found.push_back(frame);
  }
  return found;
}

/// 1 - 2 - … - n, with routes between 1 and n at all.
void warm_up(Network& network) {
  connect_chain(network);
  network.send(1, network.size());
  network.run(1s);
  ASSERT_EQ(network.node(network.size()).messages.size(), 1u);
  network.sent.clear();
  network.node(1).fates.clear();
}

TEST(HopAcknowledgement, AMessageIsHandedOverWhenTheNextHopHasAcknowledgedIt) {
  Network network = silent_links(3);
  warm_up(network);
  const Time sent_at = network.clock.now();
  const MessageId message = network.send(1, 3);
  network.run(1s);
  EXPECT_EQ(network.node(3).messages.size(), 2u);
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates[0].id, message);
  EXPECT_EQ(network.node(1).fates[0].fate, Fate::kHandedOver);
  EXPECT_EQ(network.node(1).fates[0].at, sent_at + 2 * Network::kHop);  // there and back
  EXPECT_EQ(sent(network, 1, is_data).size(), 1u);
  EXPECT_EQ(sent(network, 2, is_ack).size(), 1u);
  EXPECT_EQ(sent(network, 3, is_ack).size(), 1u);
}

TEST(HopAcknowledgement, AFloodIsHandedOverAtOnceAndNotAcknowledged) {
  Network network = silent_links(2);
  connect_chain(network);
  network.flood(1);
  network.run(Duration::zero());
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates[0].fate, Fate::kHandedOver);
  network.run(1s);
  EXPECT_EQ(network.node(2).messages.size(), 1u);
  EXPECT_TRUE(sent(network, 2, is_ack).empty());
}

TEST(HopAcknowledgement, WhatIsLostIsSentAgainAfterTimesThatDouble) {
  Network network = silent_links(2);
  warm_up(network);
  const Time start = network.clock.now();
  network.is_lost = [&](AgentId, AgentId) { return network.clock.now() < start + 200ms; };
  network.send(1, 2);
  network.run(1s);
  const auto frames = sent(network, 1, is_data);
  ASSERT_EQ(frames.size(), 4u);
  const Duration after[] = {0ms, 50ms, 150ms, 350ms};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(frames[i].at, start + after[i]);
    EXPECT_EQ(frames[i].bytes, frames[0].bytes);
  }
  EXPECT_EQ(network.node(2).messages.size(), 2u);
  EXPECT_TRUE(network.node(1).lost.empty());
}

TEST(HopAcknowledgement, ALostAcknowledgementDoesNotDeliverTwice) {
  Network network = silent_links(3);
  warm_up(network);
  int lost = 0;  // the first two acknowledgements of 2
  network.is_lost = [&](AgentId from, AgentId to) {
    return from == id(2) && to == id(1) && lost++ < 2;
  };
  network.send(1, 3);
  network.run(1s);
  EXPECT_EQ(sent(network, 1, is_data).size(), 3u);
  EXPECT_EQ(sent(network, 2, is_ack).size(), 3u);   // each copy is acknowledged …
  EXPECT_EQ(sent(network, 2, is_data).size(), 1u);  // … and the first passed on
  EXPECT_EQ(network.node(3).messages.size(), 2u);
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates[0].fate, Fate::kHandedOver);
}

TEST(HopAcknowledgement, ANeighbourThatNeverAnswersIsGivenUpAfterTheLastAttempt) {
  Network network = silent_links(2);
  warm_up(network);
  network.disconnect(1, 2);
  const Time start = network.clock.now();
  network.send(1, 2);
  network.run(749ms);
  EXPECT_TRUE(network.node(1).lost.empty());
  EXPECT_EQ(network.node(1).router->routes("help", id(2)).size(), 1u);
  network.run(1ms);  // 50 + 100 + 200 + 400
  EXPECT_EQ(network.clock.now(), start + 750ms);
  EXPECT_EQ(network.node(1).lost, std::vector{id(2)});
  EXPECT_TRUE(network.node(1).router->routes("help", id(2)).empty());
  EXPECT_EQ(sent(network, 1, is_data).size(), 4u);
  network.run(60s);
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates[0].fate, Fate::kNoRoute);
}

// 1 - {2, 3} - 4
TEST(HopAcknowledgement, AHopGivenUpIsSalvagedOverAnotherRoute) {
  Network network = silent_links(4);
  for (const auto& [a, b] : {std::pair{1, 2}, {2, 4}, {1, 3}, {3, 4}}) network.connect(a, b);
  network.send(1, 4);
  network.run(1s);
  ASSERT_EQ(network.node(1).router->routes("help", id(4)).size(), 2u);
  network.disconnect(1, 2);
  network.disconnect(2, 4);
  for (int i = 0; i < 10; ++i) network.send(1, 4);  // about half of them try 2 first
  network.run(2s);
  EXPECT_EQ(network.node(4).messages.size(), 11u);
  EXPECT_EQ(network.node(1).lost, std::vector{id(2)});
  EXPECT_EQ(network.node(1).fates.size(), 11u);
  for (const FateRecord& fate : network.node(1).fates) EXPECT_EQ(fate.fate, Fate::kHandedOver);
}

TEST(HopAcknowledgement, ABackwardAntIsSentAgainToo) {
  Network network = silent_links(2);
  connect_chain(network);
  int lost = 0;  // the backward ant
  network.is_lost = [&](AgentId from, AgentId) { return from == id(2) && lost++ < 1; };
  network.send(1, 2);
  network.run(1s);  // well before the next forward ant
  EXPECT_EQ(network.node(2).messages.size(), 1u);
  ASSERT_EQ(network.node(1).discoveries.size(), 1u);
  EXPECT_EQ(network.node(1).discoveries[0].took, 50ms + 2 * Network::kHop);
}

TEST(HopAcknowledgement, ACopyOfABackwardAntIsNotPassedOn) {
  Network network = silent_links(3);
  connect_chain(network);
  bool is_first = true;  // of what 2 sends to 3 alone: the acknowledgement of the backward ant
  network.is_lost = [&](AgentId from, AgentId to) {
    if (from != id(2) || to != id(3) || network.sent.back().to != id(3)) return false;
    return std::exchange(is_first, false);
  };
  network.send(1, 3);
  network.run(1s);
  EXPECT_FALSE(is_first);
  EXPECT_EQ(network.node(3).messages.size(), 1u);
  const auto is_ant = [](const SentFrame& f) { return f.bytes.front() == 0x14 && !is_data(f); };
  EXPECT_EQ(sent(network, 3, is_ant).size(), 2u);
  EXPECT_EQ(sent(network, 2, is_ant).size(), 1u);
}

TEST(HopAcknowledgement, OnlyTheNextHopCanAcknowledge) {
  Network network = silent_links(3);
  warm_up(network);
  network.is_lost = [](AgentId, AgentId) { return true; };
  network.send(1, 3);
  const auto parsed = parse_frame(network.sent.back().bytes);
  const HopNumber number = std::get<Numbered>(*parsed).number;
  network.node(1).router->on_frame({.from = id(3)}, encode(HopAck{number}));
  network.node(1).router->on_frame({.from = id(2)}, encode(HopAck{number + 1}));
  network.run(Duration::zero());
  EXPECT_TRUE(network.node(1).fates.empty());
  network.node(1).router->on_frame({.from = id(2)}, encode(HopAck{number}));
  network.node(1).router->on_frame({.from = id(2)}, encode(HopAck{number}));
  network.run(Duration::zero());
  EXPECT_EQ(network.node(1).fates.size(), 1u);
  network.run(1s);
  EXPECT_EQ(sent(network, 1, is_data).size(), 1u);
}

// A queue below that holds 5 frames for 1 ms each, and drops the rest without a word.
TEST(HopAcknowledgement, ABurstDoesNotOverrunAShortQueueBelow) {
  Network network = silent_links(2);
  warm_up(network);
  std::vector<Time> queued;
  network.refusal = [&](AgentId from) -> std::optional<Verdict> {
    if (from != id(1)) return std::nullopt;
    std::erase_if(queued, [&](Time t) { return t + 5ms <= network.clock.now(); });
    if (queued.size() == 5) return Verdict::kQueueFull;
    queued.push_back(network.clock.now());
    return std::nullopt;
  };
  for (int i = 0; i < 50; ++i) network.send(1, 2);
  network.run(10s);
  EXPECT_EQ(network.node(2).messages.size(), 51u);
  EXPECT_EQ(network.node(1).fates.size(), 50u);
  EXPECT_TRUE(network.node(1).lost.empty());
}

TEST(HopAcknowledgement, WhatFindsNoRoomToWaitIsQueueFull) {
  RoutingConfig config = kAcknowledging;
  config.buffer_limit = 10;
  Network network = silent_links(2, config);
  warm_up(network);
  for (int i = 0; i < 20; ++i) network.send(1, 2);
  network.run(10s);
  int full = 0;
  for (const FateRecord& fate : network.node(1).fates) full += fate.fate == Fate::kQueueFull;
  EXPECT_EQ(full, 6);  // 20 less 4 in flight and 10 waiting
  EXPECT_EQ(network.node(1).fates.size(), 20u);
  EXPECT_EQ(network.node(2).messages.size(), 15u);
}

TEST(HopAcknowledgement, ANeighbourGivenUpTakesAllItsFramesAlong) {
  Network network = silent_links(2);
  warm_up(network);
  network.disconnect(1, 2);
  for (int i = 0; i < 20; ++i) network.send(1, 2);
  network.run(750ms);
  EXPECT_EQ(sent(network, 1, is_data).size(), 4 * HopAcknowledgement::kWindow);
  EXPECT_EQ(network.node(1).lost.size(), 1u);
  network.connect(1, 2);
  network.run(30s);  // all wait for the new search, which the first started
  EXPECT_EQ(network.node(2).messages.size(), 21u);
  EXPECT_EQ(network.node(1).fates.size(), 20u);
}

TEST(HopAcknowledgement, AWindowFullOfBestEffortHoldsNoVoiceBack) {
  Network network = silent_links(2);
  warm_up(network);
  const Time start = network.clock.now();
  network.is_lost = [&](AgentId, AgentId) { return network.clock.now() == start; };
  for (std::size_t i = 0; i < HopAcknowledgement::kWindow + 3; ++i) network.send(1, 2);
  network.run(Duration{1ms});
  network.send(1, 2, "help", Priority::kVoice);
  network.run(Duration{3ms});
  const auto frames = sent(network, 1, is_data);
  ASSERT_EQ(frames.size(), HopAcknowledgement::kWindow + 1);
  EXPECT_EQ(frames.back().priority, Priority::kVoice);
  ASSERT_EQ(network.node(2).messages.size(), 2u);
  EXPECT_EQ(network.node(2).messages.back().priority, Priority::kVoice);
  const auto acks = sent(network, 2, is_ack);
  ASSERT_EQ(acks.size(), 1u);
  EXPECT_EQ(acks.front().priority, Priority::kVoice) << "as the frame that it acknowledges";
  network.run(10s);
  EXPECT_EQ(network.node(2).messages.size(), HopAcknowledgement::kWindow + 5);
}

TEST(HopAcknowledgement, EachAccessCategoryHasItsOwnRoomForFramesThatWait) {
  RoutingConfig config = kAcknowledging;
  config.buffer_limit = 1;
  Network network = silent_links(2, config);
  warm_up(network);
  for (const Priority priority : {Priority::kBestEffort, Priority{3}, Priority::kVoice}) {
    for (int i = 0; i < 4; ++i) network.send(1, 2, "help", priority);
  }
  network.run(1s);
  int full = 0;
  for (const FateRecord& record : network.node(1).fates) full += record.fate == Fate::kQueueFull;
  EXPECT_EQ(full, 3) << "0 and 3 are one category: 8 frames, a window of 4 and one that waits";
  EXPECT_EQ(network.node(2).messages.size(), 1 + 5 + 4u);
}

// A node with a better link answers one without: both may stand in one network.
TEST(HopAcknowledgement, ALinkWithStatusAcknowledgesWhatIsNumberedAndNumbersNothing) {
  Network network(2, kAcknowledging);
  connect_chain(network);
  const Data data{.header = {"help", id(2), id(1), 1}, .id = 1, .transmissions = 1, .payload = {}};
  network.node(1).router->on_frame({.from = id(2)}, encode_numbered(5, encode(data)));
  EXPECT_EQ(network.node(1).messages.size(), 1u);
  ASSERT_EQ(network.sent.size(), 1u);
  EXPECT_EQ(network.sent[0].bytes, encode(HopAck{5}));
  network.send(1, 2);
  network.run(1s);
  for (const SentFrame& frame : network.sent) EXPECT_NE(frame.bytes.front(), 0x14);
}

TEST(HopAcknowledgement, WhatTheLinkReportsAllTheSameIsIgnored) {
  Network network = silent_links(2);
  warm_up(network);
  network.send(1, 2);
  for (LinkTag tag = 0; tag < 100; ++tag) {
    network.node(1).router->on_transmitted({.tag = tag, .verdict = Verdict::kRetryLimit});
  }
  EXPECT_TRUE(network.node(1).lost.empty());
  network.run(1s);
  EXPECT_EQ(network.node(2).messages.size(), 2u);
}

// The others remember the numbers of its former life.
TEST(HopAcknowledgement, ANodeThatRestartsIsHeardIfItsNumbersStartElsewhere) {
  for (const bool elsewhere : {false, true}) {
    Network network = silent_links(2);
    warm_up(network);
    RoutingConfig second_life = kAcknowledging;
    second_life.first_sequence = elsewhere ? 1'000'000 : 0;
    TestNode& node = network.node(1);
    node.router = std::make_unique<Router>(node.self, second_life, RouterStreams(2, "second life"),
                                           RouterPorts{node, network.clock, node, node});
    network.send(1, 2);
    network.run(10s);
    EXPECT_EQ(network.node(2).messages.size(), elsewhere ? 2u : 1u);
  }
}

TEST(HopAcknowledgement, WithoutSnrThePathSaysNothingOfIt) {
  Network network = silent_links(3);
  warm_up(network);
  const auto routes = network.node(1).router->routes("help", id(3));
  ASSERT_EQ(routes.size(), 1u);
  EXPECT_EQ(routes[0].path.hops, 2);
  EXPECT_EQ(routes[0].path.min_snr_db, 0.0);
  for (const Neighbour& neighbour : network.node(1).heard) EXPECT_EQ(neighbour.rssi_dbm, 0.0);
}

}  // namespace
}  // namespace hal::node::routing::test
