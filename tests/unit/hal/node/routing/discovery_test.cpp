#include <gtest/gtest.h>

#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::test {
namespace {

const RoutingConfig kNoJitter{.jitter_max = Duration::zero()};

TEST(Discovery, OfANeighbourTakesOneBroadcastAndOneUnicast) {
  Network network(2);
  connect_chain(network);
  network.send(1, 2);
  network.run(1s);
  ASSERT_EQ(network.node(1).discoveries.size(), 1u);
  EXPECT_TRUE(network.node(1).discoveries[0].found);
  EXPECT_EQ(network.node(1).discoveries[0].took, 2 * Network::kHop);
}

TEST(Discovery, OverAChainTakesTwoHopTimesPerHopWithoutJitter) {
  Network network(6, kNoJitter);
  connect_chain(network);
  network.send(1, 6);
  network.run(1s);
  ASSERT_EQ(network.node(1).discoveries.size(), 1u);
  EXPECT_EQ(network.node(1).discoveries[0].took, 2 * 5 * Network::kHop);
}

TEST(Discovery, EachRelayOfTheForwardAntAddsAtMostTheJitter) {
  double total = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Network network(3, {}, seed);
    connect_chain(network);
    network.send(1, 3);
    network.run(1s);
    ASSERT_EQ(network.node(1).discoveries.size(), 1u);
    const Duration jitter = network.node(1).discoveries[0].took - 4 * Network::kHop;
    EXPECT_GE(jitter, 0ms);
    EXPECT_LT(jitter, 100ms);
    total += to_seconds(jitter);
  }
  // Mean of U(0, 100 ms) over 200 seeds: standard error 100 / sqrt(12 * 200) = 2.04 ms; 4 of them.
  EXPECT_NEAR(total / 200, 0.050, 0.0082);
}

TEST(Discovery, TeachesEveryNodeOfThePathBothWays) {
  Network network(4, kNoJitter);
  connect_chain(network);
  network.send(1, 4);
  network.run(1s);
  for (int at = 1; at <= 4; ++at) {
    const auto to_target = network.node(at).router->routes("help", id(4));
    const auto to_origin = network.node(at).router->routes("help", id(1));
    ASSERT_EQ(to_target.size(), at == 4 ? 0u : 1u) << at;
    ASSERT_EQ(to_origin.size(), at == 1 ? 0u : 1u) << at;
    if (at < 4) {
      EXPECT_EQ(to_target[0].next_hop, id(at + 1));
      EXPECT_EQ(to_target[0].path.hops, 4 - at);
    }
    if (at > 1) {
      EXPECT_EQ(to_origin[0].next_hop, id(at - 1));
      EXPECT_EQ(to_origin[0].path.hops, at - 1);
    }
  }
}

TEST(Discovery, GathersTheStatisticsOfThePath) {
  Network network(4, kNoJitter);
  connect_chain(network);
  network.snr_db = [](AgentId from, AgentId to) {
    return std::min(from, to) == id(2) ? 11.0 : 30.0;  // the hop between 2 and 3 is the weakest
  };
  network.send(1, 4);
  network.run(1s);
  const Route route = network.node(1).router->routes("help", id(4)).at(0);
  EXPECT_EQ(route.path.delay, 3ms);               // expected_delay() of three hops
  EXPECT_DOUBLE_EQ(route.path.min_snr_db, 11.0);  // dB
  EXPECT_DOUBLE_EQ(route.path.energy, 3 * 0.5);   // J
  const Route last_hop = network.node(3).router->routes("help", id(4)).at(0);
  EXPECT_DOUBLE_EQ(last_hop.path.min_snr_db, 30.0);
  const Route back = network.node(4).router->routes("help", id(1)).at(0);
  EXPECT_EQ(back.path.delay, 3ms);
  EXPECT_DOUBLE_EQ(back.path.min_snr_db, 11.0);
}

TEST(Discovery, KeepsClassesApart) {
  Network network(2);
  connect_chain(network);
  network.send(1, 2, "help");
  network.run(1s);
  EXPECT_EQ(network.node(1).router->routes("help", id(2)).size(), 1u);
  EXPECT_TRUE(network.node(1).router->routes("audio", id(2)).empty());
}

// Two ways of equal length round a diamond: the destination answers both copies.
TEST(Discovery, FindsBothArmsOfADiamond) {
  Network network(4, kNoJitter);
  for (const int arm : {2, 3}) {
    network.connect(1, arm);
    network.connect(arm, 4);
  }
  network.send(1, 4);
  network.run(1s);
  const auto routes = network.node(1).router->routes("help", id(4));
  ASSERT_EQ(routes.size(), 2u);
  EXPECT_EQ(routes[0].next_hop, id(2));
  EXPECT_EQ(routes[1].next_hop, id(3));
}

// Arms of 2 and 4 hops: the long one is beyond 1.5 times the short one.
TEST(Discovery, DoesNotAnswerCopiesBeyondTheAcceptanceBand) {
  Network network(6, kNoJitter);
  for (const auto& [a, b] : {std::pair{1, 2}, {2, 6}, {1, 3}, {3, 4}, {4, 5}, {5, 6}}) {
    network.connect(a, b);
  }
  network.send(1, 6);
  network.run(1s);
  const auto routes = network.node(1).router->routes("help", id(6));
  ASSERT_EQ(routes.size(), 1u);
  EXPECT_EQ(routes[0].next_hop, id(2));
}

// Arms of 2 and 3 hops: exactly 1.5 times in hops and in time, just inside.
TEST(Discovery, AnswersACopyAtTheEdgeOfTheBand) {
  Network network(5, kNoJitter);
  for (const auto& [a, b] : {std::pair{1, 2}, {2, 5}, {1, 3}, {3, 4}, {4, 5}}) {
    network.connect(a, b);
  }
  network.send(1, 5);
  network.run(1s);
  EXPECT_EQ(network.node(1).router->routes("help", id(5)).size(), 2u);
}

TEST(Discovery, RelaysForwardACopyOnlyOnceUnlessTheBandHoldsEverywhere) {
  for (const bool everywhere : {false, true}) {
    Network network(5, {.jitter_max = Duration::zero(), .accept_anywhere = everywhere});
    // 1 reaches 4 over 2 and over 3 at the same time; 5 hangs behind 4.
    for (const auto& [a, b] : {std::pair{1, 2}, {1, 3}, {2, 4}, {3, 4}, {4, 5}}) {
      network.connect(a, b);
    }
    network.send(1, 5);
    network.run(1s);
    EXPECT_EQ(network.node(1).router->routes("help", id(5)).size(), everywhere ? 2u : 1u);
  }
}

TEST(Discovery, IsRepeatedAndItsTimeCountsFromTheFirstTry) {
  Network network(2, {.retry_jitter = 0});
  connect_chain(network);
  int ants = 0;
  network.is_lost = [&](AgentId from, AgentId) { return from == id(1) && ++ants <= 2; };
  network.send(1, 2);
  network.run(20s);
  ASSERT_EQ(network.node(1).discoveries.size(), 1u);
  EXPECT_TRUE(network.node(1).discoveries[0].found);
  EXPECT_EQ(network.node(1).discoveries[0].took, 2 * 5s + 2 * Network::kHop);
}

TEST(Discovery, IsGivenUpOnePeriodAfterTheLastTry) {
  Network network(2, {.retry_jitter = 0, .buffer_age = 60s});
  const MessageId message = network.send(1, 2);
  network.run(20s);
  EXPECT_EQ(network.sent.size(), 3u);  // retries = 3 in all
  ASSERT_EQ(network.node(1).discoveries.size(), 1u);
  EXPECT_FALSE(network.node(1).discoveries[0].found);
  EXPECT_EQ(network.node(1).discoveries[0].took, 15s);
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates[0].id, message);
  EXPECT_EQ(network.node(1).fates[0].fate, Fate::kNoRoute);
  EXPECT_EQ(network.node(1).fates[0].at, Time{15s});
  ASSERT_EQ(network.ends.size(), 1u);
  EXPECT_EQ(network.ends[0].verdict, Verdict::kNoRoute);
}

TEST(Discovery, StartsAfreshAfterItWasGivenUp) {
  Network network(2);
  network.send(1, 2);
  network.run(20s);
  network.connect(1, 2);
  network.send(1, 2);
  network.run(1s);
  ASSERT_EQ(network.node(1).discoveries.size(), 2u);
  EXPECT_EQ(network.node(1).discoveries[1].took, 2 * Network::kHop);
}

TEST(Discovery, AMessageWaitsNoLongerThanTheBufferAge) {
  Network network(2);
  network.send(1, 2);
  network.run(20s);
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates[0].fate, Fate::kNoRoute);
  EXPECT_EQ(network.node(1).fates[0].at, Time{10s});
  ASSERT_EQ(network.ends.size(), 1u);
  EXPECT_EQ(network.ends[0].verdict, Verdict::kExpired);
}

TEST(Discovery, OneSearchServesAllMessagesInOrder) {
  Network network(3);
  connect_chain(network);
  for (int i = 0; i < 5; ++i) network.send(1, 3);
  network.run(1s);
  EXPECT_EQ(network.node(1).discoveries.size(), 1u);
  ASSERT_EQ(network.node(3).messages.size(), 5u);
  for (MessageId i = 0; i < 5; ++i) EXPECT_EQ(network.node(3).messages[i].id, i + 1);
}

TEST(Discovery, RefusesMoreMessagesThanTheBufferHolds) {
  Network network(2, {.buffer_limit = 3});
  for (int i = 0; i < 5; ++i) network.send(1, 2);
  network.run(1ms);
  ASSERT_EQ(network.node(1).fates.size(), 2u);
  EXPECT_EQ(network.node(1).fates[0].id, 4u);
  EXPECT_EQ(network.node(1).fates[0].fate, Fate::kQueueFull);
  EXPECT_EQ(network.node(1).fates[0].at, Time{});
  EXPECT_EQ(network.node(1).fates[1].id, 5u);
}

// Arms of 2 and 3 hops: answers come home after 4 and 6 ms. The second one, by then of a search
// before the invalidation, must not end the search that started at 5 ms.
TEST(Discovery, AnswersToAnEarlierSearchDoNotEndThisOne) {
  Network network(5, kNoJitter);
  for (const auto& [a, b] : {std::pair{1, 2}, {2, 5}, {1, 3}, {3, 4}, {4, 5}}) {
    network.connect(a, b);
  }
  network.send(1, 5);
  network.run(5ms);
  network.node(1).router->invalidate("help", id(5));
  network.send(1, 5);
  network.run(1s);
  ASSERT_EQ(network.node(1).discoveries.size(), 2u);
  EXPECT_EQ(network.node(1).discoveries[1].took, 4 * Network::kHop);
}

TEST(Discovery, AReplyNeedsNoSearchOfItsOwn) {
  Network network(4);
  connect_chain(network);
  network.send(1, 4);
  network.run(1s);
  const std::size_t before = network.sent.size();
  network.send(4, 1);
  network.run(1s);
  EXPECT_TRUE(network.node(4).discoveries.empty());
  EXPECT_EQ(network.sent.size() - before, 3u);  // three hops, no ant
  EXPECT_EQ(network.node(1).messages.size(), 1u);
}

TEST(Discovery, ForwardAntsDieAtTheHopLimit) {
  Network network(5, {.jitter_max = Duration::zero(), .hop_limit = 3});
  connect_chain(network);
  network.send(1, 4);
  network.send(1, 5);
  network.run(1s);
  EXPECT_EQ(network.node(4).messages.size(), 1u);
  EXPECT_TRUE(network.node(5).heard.size() == 0);
}

}  // namespace
}  // namespace hal::node::routing::test
