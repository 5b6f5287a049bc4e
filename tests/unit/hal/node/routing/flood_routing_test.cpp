#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::test {
namespace {

const RoutingConfig kFlood{.algorithm = Algorithm::kFlooding};

int ends_with(const Network& network, Verdict verdict) {
  return static_cast<int>(std::ranges::count(network.ends, verdict, &EndRecord::verdict));
}

TEST(FloodRouting, DeliversAMessageOnceToItsDestinationAndToNobodyElse) {
  Network network(25, kFlood);
  connect_grid(network, 5);
  network.send(1, 25);
  network.run(20s);
  for (int number = 1; number <= 25; ++number) {
    EXPECT_EQ(network.node(number).messages.size(), number == 25 ? 1u : 0u) << number;
  }
  EXPECT_EQ(network.node(25).transmissions_of.at(0), 8);
  // Every node but the destination sends it once.
  EXPECT_EQ(network.sent.size(), 24u);
  EXPECT_EQ(network.node(2).events[ProtocolEvent::kFloodRelayed], 1);
}

TEST(FloodRouting, TellsTheSenderOnceThatTheMessageLeft) {
  Network network(3, kFlood);
  connect_chain(network);
  const MessageId sent = network.send(1, 3);
  network.run(20s);
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates[0].id, sent);
  EXPECT_EQ(network.node(1).fates[0].fate, Fate::kHandedOver);
}

TEST(FloodRouting, AMessageThatReachesNobodyExpiresOnce) {
  Network network(4, kFlood);
  connect_chain(network);
  network.disconnect(3, 4);
  network.send(1, 4);
  network.run(20s);
  EXPECT_TRUE(network.node(4).messages.empty());
  ASSERT_EQ(network.ends.size(), 1u);
  EXPECT_EQ(network.ends[0].verdict, Verdict::kExpired);
  EXPECT_EQ(network.ends[0].node, id(1));
}

TEST(FloodRouting, OneThatCouldNotLeaveEndsWithTheLinksVerdict) {
  Network network(2, kFlood);
  connect_chain(network);
  network.refusal = [](AgentId) { return Verdict::kQueueFull; };
  network.send(1, 2);
  network.run(20s);
  ASSERT_EQ(network.ends.size(), 1u);
  EXPECT_EQ(network.ends[0].verdict, Verdict::kQueueFull);
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates[0].fate, Fate::kQueueFull);
}

TEST(FloodRouting, GoesNoFurtherThanTheHopLimit) {
  RoutingConfig config = kFlood;
  config.hop_limit = 3;
  Network network(6, config);
  connect_chain(network);
  network.send(1, 4);
  network.send(1, 5);
  network.run(20s);
  EXPECT_EQ(network.node(4).messages.size(), 1u);
  EXPECT_TRUE(network.node(5).messages.empty());
}

TEST(FloodRouting, StillFloodsToEveryoneAndToTheNeighbours) {
  Network network(4, kFlood);
  connect_chain(network);
  network.flood(1);
  network.send(2, kNeighbours.value);
  network.run(20s);
  EXPECT_EQ(network.node(4).messages.size(), 1u);
  EXPECT_EQ(network.node(3).messages.size(), 2u);
  EXPECT_EQ(network.node(1).messages.size(), 1u);
  EXPECT_EQ(ends_with(network, Verdict::kExpired), 0);
}

TEST(FloodRouting, WorksOverALinkWithoutTransmitStatus) {
  Network network(9, kFlood, 1, Network::kNothing);
  connect_grid(network, 3);
  network.send(1, 9);
  network.run(20s);
  EXPECT_EQ(network.node(9).messages.size(), 1u);
  EXPECT_EQ(network.node(5).router->neighbours().size(), 4u);
}

// Half of all receptions are lost: copies on other ways make up for many of them.
TEST(FloodRouting, NeverDeliversTwiceHoweverManyCopiesAreLost) {
  Network network(25, kFlood);
  connect_grid(network, 5);
  RandomStream random(1, "loss");
  network.is_lost = [&random](AgentId, AgentId) { return random.uniform() < 0.5; };
  for (int i = 0; i < 50; ++i) network.send(1, 25);
  network.run(60s);
  const auto delivered = network.node(25).messages.size();
  EXPECT_GT(delivered, 5u);
  EXPECT_LE(delivered, 50u);
  EXPECT_EQ(ends_with(network, Verdict::kDelivered), static_cast<int>(delivered));
  EXPECT_EQ(network.node(1).fates.size(), 50u);
}

}  // namespace
}  // namespace hal::node::routing::test
