#include <gtest/gtest.h>

#include "hal/node/routing/packet.h"
#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::test {
namespace {

const RoutingConfig kAtOnce{.jitter_max = Duration::zero()};

/// 1 - {2, 3} - 4: two ways from 1 to 4.
void connect_diamond(Network& network) {
  for (const auto& [a, b] : {std::pair{1, 2}, {2, 4}, {1, 3}, {3, 4}}) network.connect(a, b);
}

TEST(Forwarding, ARelayPassesOnInTheInstantOfReception) {
  Network network(5, kAtOnce);
  connect_chain(network);
  network.send(1, 5);
  network.run(1s);
  network.sent.clear();
  const Time sent = network.clock.now();
  network.send(1, 5);
  network.run(1s);
  ASSERT_EQ(network.sent.size(), 4u);
  for (int hop = 0; hop < 4; ++hop) {
    EXPECT_EQ(network.sent[static_cast<std::size_t>(hop)].at, sent + hop * Network::kHop);
  }
  EXPECT_EQ(network.ends.back().at, sent + 4 * Network::kHop);
}

TEST(Forwarding, DeliversTheMessageAsItWasSent) {
  Network network(3);
  connect_chain(network);
  network.send(1, 3, "audio");
  network.run(1s);
  ASSERT_EQ(network.node(3).messages.size(), 1u);
  const Message expected{
      .source = id(1), .destination = id(3), .id = 1, .topic = "audio", .payload = {1}};
  EXPECT_EQ(network.node(3).messages[0], expected);
  EXPECT_EQ(network.node(3).transmissions_of, std::vector{2}) << "over two hops";
  EXPECT_TRUE(network.node(2).messages.empty());
}

TEST(Forwarding, IsHandedOverWhenTheFirstHopAcknowledges) {
  Network network(3);
  connect_chain(network);
  network.send(1, 3);
  network.run(1s);
  const Time sent = network.clock.now();
  const MessageId message = network.send(1, 3);
  network.run(1s);
  ASSERT_EQ(network.node(1).fates.size(), 2u);
  EXPECT_EQ(network.node(1).fates[1].id, message);
  EXPECT_EQ(network.node(1).fates[1].fate, Fate::kHandedOver);
  EXPECT_EQ(network.node(1).fates[1].at, sent + Network::kHop);
}

// From 1, both arms are two hops long: each should carry half of 400 messages. Binomial standard
// deviation sqrt(400 / 4) = 10; four of them.
TEST(Forwarding, SpreadsOverEqualRoutes) {
  Network network(4, kAtOnce);
  connect_diamond(network);
  network.send(1, 4);
  network.run(1s);
  network.sent.clear();
  for (int i = 0; i < 400; ++i) network.send(1, 4);
  network.run(1s);
  int over_two = 0;
  for (const SentFrame& frame : network.sent) over_two += frame.from == id(1) && frame.to == id(2);
  EXPECT_NEAR(over_two, 200, 40);
}

TEST(Forwarding, ANeighbourThatDoesNotAnswerLosesAllItsRoutes) {
  Network network(4, kAtOnce);
  connect_diamond(network);
  network.send(1, 4, "help");
  network.send(1, 4, "audio");
  network.send(1, 2, "help");
  network.run(1s);
  network.disconnect(1, 2);
  network.node(1).changes.clear();
  network.send(1, 2, "help");
  network.run(2ms);
  EXPECT_EQ(network.node(1).lost, std::vector{id(2)});
  const std::vector<RouteChange> expected = {
      {{"audio", id(4), id(2), {}}, true},
      {{"help", id(2), id(2), {}}, true},
      {{"help", id(4), id(2), {}}, true},
  };
  EXPECT_EQ(network.node(1).changes, expected);
}

TEST(Forwarding, SalvagesOverAnotherRoute) {
  Network network(4, kAtOnce);
  connect_diamond(network);
  network.send(1, 4);
  network.run(1s);
  network.disconnect(1, 2);
  network.disconnect(2, 4);
  for (int i = 0; i < 10; ++i) network.send(1, 4);  // about half of them try 2 first
  network.run(1s);
  EXPECT_EQ(network.node(4).messages.size(), 11u);
  EXPECT_EQ(network.node(1).fates.size(), 11u);
  for (const FateRecord& fate : network.node(1).fates) EXPECT_EQ(fate.fate, Fate::kHandedOver);
  EXPECT_EQ(network.node(1).lost.size(), 1u);  // reported once for all frames that failed
}

TEST(Forwarding, SalvagesByANewSearchIfNoRouteIsLeft) {
  Network network(4, kAtOnce);
  network.connect(1, 2);
  network.connect(2, 4);
  network.send(1, 4);
  network.run(1s);
  network.disconnect(1, 2);
  network.connect(1, 3);
  network.connect(3, 4);
  network.send(1, 4);
  network.run(1s);
  EXPECT_EQ(network.node(4).messages.size(), 2u);
  EXPECT_EQ(network.node(1).discoveries.size(), 2u);
}

TEST(Forwarding, ARelaySalvagesToo) {
  Network network(5, kAtOnce);
  // 1 - 2 - {3, 4} - 5
  for (const auto& [a, b] : {std::pair{1, 2}, {2, 3}, {3, 5}}) network.connect(a, b);
  network.send(1, 5);
  network.run(1s);
  network.disconnect(2, 3);
  network.connect(2, 4);
  network.connect(4, 5);
  network.send(1, 5);
  network.run(1s);
  EXPECT_EQ(network.node(5).messages.size(), 2u);
  EXPECT_EQ(network.node(2).discoveries.size(), 1u);
}

TEST(Forwarding, AMessageThatDiesAtARelayIsReportedThereAndStaysHandedOver) {
  Network network(3, kAtOnce);
  connect_chain(network);
  network.send(1, 3);
  network.run(1s);
  network.disconnect(2, 3);
  network.ends.clear();
  const MessageId message = network.send(1, 3);
  network.run(30s);
  ASSERT_EQ(network.node(1).fates.size(), 2u);
  EXPECT_EQ(network.node(1).fates[1].fate, Fate::kHandedOver);
  ASSERT_EQ(network.ends.size(), 1u);
  EXPECT_EQ(network.ends[0].node, id(2));
  EXPECT_EQ(network.ends[0].sent_by, id(1));
  EXPECT_EQ(network.ends[0].id, message);
  EXPECT_EQ(network.ends[0].verdict, Verdict::kExpired);  // buffer_age passes before the retries
  EXPECT_TRUE(network.node(2).fates.empty());
}

TEST(Forwarding, SalvageThatFindsNothingEndsInNoRoute) {
  Network network(2, {.buffer_age = 60s});
  connect_chain(network);
  network.send(1, 2);
  network.run(1s);
  network.disconnect(1, 2);
  network.send(1, 2);
  network.run(30s);
  ASSERT_EQ(network.node(1).fates.size(), 2u);
  EXPECT_EQ(network.node(1).fates[1].fate, Fate::kNoRoute);
  EXPECT_EQ(network.ends.back().verdict, Verdict::kNoRoute);
}

// Ants get through and data does not: every salvage finds the same way again.
TEST(Forwarding, SalvageStopsAtTheHopLimit) {
  Network network(2, {.jitter_max = Duration::zero(), .hop_limit = 5});
  connect_chain(network);
  network.is_lost = [&](AgentId from, AgentId) {
    return from == id(1) && network.sent.back().to == id(2);
  };
  network.send(1, 2);
  network.run(1s);
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates[0].fate, Fate::kFailed);
  EXPECT_EQ(network.ends.back().verdict, Verdict::kRetryLimit);
  int data = 0;
  for (const SentFrame& frame : network.sent) data += frame.from == id(1) && frame.to == id(2);
  EXPECT_EQ(data, 5);
}

TEST(Forwarding, ALocalRefusalIsTheFate) {
  for (const auto& [verdict, fate] :
       {std::pair{Verdict::kQueueFull, Fate::kQueueFull}, {Verdict::kRadioOff, Fate::kFailed}}) {
    Network network(2);
    connect_chain(network);
    network.send(1, 2);
    network.run(1s);
    network.refusal = [v = verdict](AgentId) { return v; };
    network.send(1, 2);
    network.run(1s);
    ASSERT_EQ(network.node(1).fates.size(), 2u);
    EXPECT_EQ(network.node(1).fates[1].fate, fate);
    EXPECT_EQ(network.ends.back().verdict, verdict);
    EXPECT_EQ(network.node(1).router->routes("help", id(2)).size(), 1u);  // says nothing of 2
  }
}

TEST(Forwarding, InvalidationIsLocalAndForcesANewSearch) {
  Network network(3);
  connect_chain(network);
  network.send(1, 3);
  network.run(1s);
  network.node(1).changes.clear();
  network.node(1).router->invalidate("help", id(3));
  network.node(1).router->invalidate("audio", id(3));
  EXPECT_EQ(network.node(1).changes,
            (std::vector<RouteChange>{{{"help", id(3), id(2), {}}, true}}));
  EXPECT_TRUE(network.node(1).router->routes("help", id(3)).empty());
  EXPECT_EQ(network.node(2).router->routes("help", id(3)).size(), 1u);
  network.send(1, 3);
  network.run(1s);
  EXPECT_EQ(network.node(1).discoveries.size(), 2u);
}

TEST(Forwarding, ARouteThatDoesNotChangeIsNotReportedAgain) {
  Network network(3, kAtOnce);
  connect_chain(network);
  network.send(1, 3);
  network.run(1s);
  network.node(1).router->invalidate("help", id(3));
  network.node(2).changes.clear();
  network.send(1, 3);
  network.run(1s);
  EXPECT_TRUE(network.node(2).changes.empty());
}

// A lost acknowledgement makes the link repeat a frame: the receiver gets it twice.
TEST(Forwarding, FramesThatTheLinkRepeatsAreTakenOnce) {
  Network network(3, kAtOnce);
  connect_chain(network);
  network.send(1, 3);
  network.run(1s);
  network.sent.clear();
  network.send(1, 3);
  network.run(1s);
  ASSERT_EQ(network.sent.size(), 2u);
  const std::vector<SentFrame> frames = network.sent;
  for (const SentFrame& frame : frames) {
    network.node(frame.to.value).router->on_frame({.from = frame.from}, frame.bytes);
  }
  network.run(1s);
  EXPECT_EQ(network.node(3).messages.size(), 2u);
  EXPECT_EQ(network.sent.size(), 2u);  // the relay did not send it again
}

// Node 2 knows two ways to 5: over 3 (2 hops) and over 1 and 4 (3 hops).
TEST(Forwarding, ARelayDoesNotSendBackWhatItGotIfThereIsAnotherWay) {
  Network network(5, kAtOnce);
  for (const auto& [a, b] : {std::pair{2, 3}, {3, 5}, {2, 1}, {1, 4}, {4, 5}}) {
    network.connect(a, b);
  }
  network.send(2, 5);
  network.run(1s);
  ASSERT_EQ(network.node(2).router->routes("help", id(5)).size(), 2u);
  network.sent.clear();
  Data data{.header = {"help", AgentId{99}, id(5), 0}, .id = 1, .transmissions = 1, .payload = {}};
  for (Sequence i = 1; i <= 100; ++i) {
    data.header.sequence = i;
    network.node(2).router->on_frame({.from = id(3)}, encode(data));
  }
  ASSERT_EQ(network.sent.size(), 100u);
  for (const SentFrame& frame : network.sent) EXPECT_EQ(frame.to, id(1));
}

TEST(Forwarding, NothingRunsAfterTheRouterIsGone) {
  // A link with status would itself report to the router that is gone.
  Network network(2, {}, 1, Network::kNothing);
  connect_chain(network);
  network.send(1, 2);
  network.run(1s);
  network.send(1, 2);  // waits for its acknowledgement
  network.send(1, 9);  // a search with its retries
  network.node(1).router.reset();
  network.node(2).router.reset();
  network.sent.clear();
  network.run(60s);
  EXPECT_TRUE(network.sent.empty());
  EXPECT_EQ(network.node(1).fates.size(), 1u);
}

TEST(Forwarding, EveryReceptionNamesANeighbour) {
  Network network(2);
  connect_chain(network);
  network.send(1, 2);
  network.run(1s);
  ASSERT_EQ(network.node(1).heard.size(), 1u);  // the backward ant
  const Neighbour expected{.id = id(2), .last_heard = Time{2ms}, .rssi_dbm = -60};
  EXPECT_EQ(network.node(1).heard[0], expected);
}

TEST(Forwarding, MalformedFramesAreCountedAndDropped) {
  Network network(2);
  network.node(1).router->on_frame({.from = id(2)}, Bytes{1, 2, 3});
  network.node(1).router->on_frame({.from = id(2)}, Bytes{});
  EXPECT_EQ(network.node(1).router->malformed_frames(), 2u);
  EXPECT_TRUE(network.node(1).messages.empty());
}

}  // namespace
}  // namespace hal::node::routing::test
