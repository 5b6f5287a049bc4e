#include <gtest/gtest.h>

#include <map>

#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::test {
namespace {

TEST(Flooding, ReachesEveryNodeOnceAndIsSentOnceByEach) {
  Network network(25);
  connect_grid(network, 5);
  network.flood(13);
  network.run(10s);
  for (int number = 1; number <= 25; ++number) {
    EXPECT_EQ(network.node(number).messages.size(), number == 13 ? 0u : 1u) << number;
  }
  std::map<AgentId, int> transmissions;
  for (const SentFrame& frame : network.sent) ++transmissions[frame.from];
  EXPECT_EQ(transmissions.size(), 25u);
  EXPECT_EQ(network.sent.size(), 25u);
  EXPECT_EQ(network.ends.size(), 24u);
  for (const EndRecord& end : network.ends) EXPECT_EQ(end.verdict, Verdict::kDelivered);
}

TEST(Flooding, LeavesTheSourceAtOnceAndTheOthersWithinTheJitter) {
  Network network(3);
  connect_chain(network);
  network.flood(1);
  network.run(10s);
  ASSERT_EQ(network.sent.size(), 3u);
  EXPECT_EQ(network.sent[0].at, Time{});
  const Duration wait = network.sent[1].at - Time{1ms};
  EXPECT_GE(wait, 0ms);
  EXPECT_LT(wait, 100ms);
}

TEST(Flooding, IsDeliveredAtTheFirstCopyBeforeTheJitter) {
  Network network(2);
  connect_chain(network);
  network.flood(1);
  network.run(1ms);
  EXPECT_EQ(network.node(2).messages.size(), 1u);
}

TEST(Flooding, ToTheNeighboursIsHeardOnceByEachOfThemAndNotRepeated) {
  Network network(4);
  connect_chain(network);
  network.send(2, kNeighbours.value);
  network.run(10s);
  EXPECT_EQ(network.sent.size(), 1u);
  EXPECT_EQ(network.node(1).messages.size(), 1u);
  EXPECT_EQ(network.node(3).messages.size(), 1u);
  EXPECT_EQ(network.node(3).messages[0].destination, kNeighbours);
  EXPECT_TRUE(network.node(4).messages.empty());
  ASSERT_EQ(network.node(2).fates.size(), 1u);
  EXPECT_EQ(network.node(2).fates[0].fate, Fate::kHandedOver);
}

TEST(Flooding, IsHandedOverWhenItLeftTheAntenna) {
  Network network(1);
  network.flood(1);
  network.run(1s);
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates[0].fate, Fate::kHandedOver);
}

TEST(Flooding, ARefusalAtTheSourceIsItsFate) {
  Network network(2);
  connect_chain(network);
  network.refusal = [](AgentId) { return Verdict::kQueueFull; };
  network.flood(1);
  network.run(1s);
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates[0].fate, Fate::kQueueFull);
  ASSERT_EQ(network.ends.size(), 1u);
  EXPECT_EQ(network.ends[0].verdict, Verdict::kQueueFull);
}

TEST(Flooding, ARefusalAtARelayIsNotTheEndOfTheMessage) {
  Network network(2);
  connect_chain(network);
  network.refusal = [](AgentId from) -> std::optional<Verdict> {
    if (from == id(2)) return Verdict::kQueueFull;
    return std::nullopt;
  };
  network.flood(1);
  network.run(1s);
  ASSERT_EQ(network.ends.size(), 1u);
  EXPECT_EQ(network.ends[0].verdict, Verdict::kDelivered);
}

TEST(Flooding, DiesAtTheHopLimit) {
  Network network(5, {.hop_limit = 2});
  connect_chain(network);
  network.flood(1);
  network.run(1s);
  EXPECT_EQ(network.node(3).messages.size(), 1u);
  EXPECT_TRUE(network.node(4).messages.empty());
}

TEST(Flooding, TwoFloodsOfOneSourceAreTwo) {
  Network network(2);
  connect_chain(network);
  network.flood(1);
  network.flood(1);
  network.run(1s);
  EXPECT_EQ(network.node(2).messages.size(), 2u);
}

}  // namespace
}  // namespace hal::node::routing::test
