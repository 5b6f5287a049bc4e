#include <gtest/gtest.h>

#include <algorithm>

#include "hal/node/routing/aodv_message.h"
#include "hal/node/routing/frame.h"
#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::test {
namespace {

using Event = ProtocolEvent;

/// Without jitter and hellos, so that times and counts are exact.
RoutingConfig quiet() {
  RoutingConfig config{.algorithm = Algorithm::kAodv, .jitter_max = Duration::zero()};
  config.aodv.hello = false;
  return config;
}

RoutingConfig with(const std::function<void(AodvConfig&)>& change) {
  RoutingConfig config = quiet();
  change(config.aodv);
  return config;
}

std::optional<Route> route(Network& network, int from, int to) {
  const auto routes = network.node(from).router->routes("help", id(to));
  return routes.empty() ? std::nullopt : std::optional<Route>{routes.front()};
}

int total(Network& network, Event event) {
  int sum = 0;
  for (int number = 1; number <= network.size(); ++number) {
    sum += network.node(number).events[event];
  }
  return sum;
}

TEST(Aodv, FindsAWayAndBothEndsKnowItAfterwards) {
  Network network(5, quiet());
  connect_chain(network);
  network.send(1, 5);
  network.run(2s);
  ASSERT_EQ(network.node(5).messages.size(), 1u);
  EXPECT_EQ(network.node(5).transmissions_of[0], 4);
  ASSERT_TRUE(route(network, 1, 5));
  EXPECT_EQ(route(network, 1, 5)->next_hop, id(2));
  EXPECT_EQ(route(network, 1, 5)->path.hops, 4);
  ASSERT_TRUE(route(network, 5, 1));
  EXPECT_EQ(route(network, 5, 1)->next_hop, id(4));
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates[0].fate, Fate::kHandedOver);
  EXPECT_EQ(network.ends.size(), 1u);
}

// RFC 3561, section 6.4: rings of 1, 3, 5, 7 hops, then NET_DIAMETER.
TEST(Aodv, WidensTheRingUntilTheDestinationIsInIt) {
  for (const auto& [hops, requests] :
       {std::pair{1, 1}, std::pair{3, 2}, std::pair{4, 3}, std::pair{7, 4}, std::pair{9, 5}}) {
    Network network(10, quiet());
    connect_chain(network);
    network.send(1, 1 + hops);
    network.run(5s);
    EXPECT_EQ(network.node(1).events[Event::kRreqSent], requests) << hops << " hops";
    EXPECT_EQ(network.node(1 + hops).messages.size(), 1u) << hops << " hops";
  }
}

// Three hops: 2 * 40 ms * (1 + 2) in vain, then 3 ms there and 3 ms back.
TEST(Aodv, WaitsRingTraversalTimeBetweenRings) {
  Network network(4, quiet());
  connect_chain(network);
  network.send(1, 4);
  network.run(2s);
  ASSERT_EQ(network.node(1).discoveries.size(), 1u);
  EXPECT_TRUE(network.node(1).discoveries[0].found);
  EXPECT_EQ(network.node(1).discoveries[0].took, 240ms + 6ms);
}

TEST(Aodv, ARingReachesNoFurtherThanItsTtl) {
  Network network(6, quiet());
  connect_chain(network);
  network.send(1, 6);
  network.run(239ms);
  EXPECT_EQ(total(network, Event::kRreqForwarded), 0);
  network.run(300ms);
  EXPECT_EQ(network.node(4).events[Event::kRreqForwarded], 0);
  EXPECT_EQ(network.node(3).events[Event::kRreqForwarded], 1);
}

// Rings take 240 + 400 + 560 + 720 ms; the whole network 2.8 s, then twice that, then twice again.
TEST(Aodv, GivesUpAfterRreqRetriesOverTheWholeNetwork) {
  RoutingConfig config = quiet();
  config.buffer_age = 60s;
  Network network(3, config);
  network.connect(1, 2);
  network.send(1, 3);
  network.run(60s);
  EXPECT_EQ(network.node(1).events[Event::kRreqSent], 4 + 3);
  ASSERT_EQ(network.node(1).discoveries.size(), 1u);
  EXPECT_FALSE(network.node(1).discoveries[0].found);
  EXPECT_EQ(network.node(1).discoveries[0].took, 1920ms + 7 * 2800ms);
  ASSERT_EQ(network.ends.size(), 1u);
  EXPECT_EQ(network.ends[0].verdict, Verdict::kNoRoute);
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates[0].fate, Fate::kNoRoute);
}

TEST(Aodv, ForgetsARouteThatNobodyUses) {
  Network network(3, quiet());
  connect_chain(network);
  network.send(1, 3);
  network.run(2s);
  ASSERT_TRUE(route(network, 1, 3));
  network.run(7s);  // MY_ROUTE_TIMEOUT is 6 s
  EXPECT_FALSE(route(network, 1, 3));
  EXPECT_TRUE(network.node(1).changes.back().removed);
}

TEST(Aodv, KeepsARouteThatIsUsed) {
  Network network(3, quiet());
  connect_chain(network);
  for (int i = 0; i < 20; ++i) {
    network.send(1, 3);
    network.run(2s);
  }
  EXPECT_EQ(network.node(3).messages.size(), 20u);
  EXPECT_EQ(network.node(1).discoveries.size(), 1u);
}

TEST(Aodv, ANodeOnTheWayAnswersAndTellsTheDestinationToo) {
  Network network(5, quiet());
  connect_chain(network);
  network.send(2, 5);
  network.run(2s);
  network.send(1, 5);
  network.run(100ms);
  EXPECT_EQ(network.node(5).messages.size(), 2u);
  EXPECT_EQ(network.node(5).events[Event::kRrepSent], 1);
  EXPECT_EQ(network.node(2).events[Event::kRrepSentForOther], 1);
  ASSERT_TRUE(route(network, 5, 1));
  EXPECT_EQ(route(network, 5, 1)->path.hops, 4);
}

TEST(Aodv, WithoutGratuitousRepliesTheDestinationIsNotTold) {
  Network network(5, with([](AodvConfig& c) { c.gratuitous_reply = false; }));
  connect_chain(network);
  network.send(2, 5);
  network.run(2s);
  network.send(1, 5);
  network.run(100ms);
  EXPECT_EQ(network.node(5).messages.size(), 2u);
  EXPECT_FALSE(route(network, 5, 1));
}

TEST(Aodv, ThatOnlyTheDestinationAnswersCanBeAskedFor) {
  Network network(5, with([](AodvConfig& c) { c.destination_only = true; }));
  connect_chain(network);
  network.send(2, 5);
  network.run(2s);
  network.send(1, 5);
  network.run(2s);
  EXPECT_EQ(network.node(5).messages.size(), 2u);
  EXPECT_EQ(network.node(5).events[Event::kRrepSent], 2);
  EXPECT_EQ(total(network, Event::kRrepSentForOther), 0);
}

// The link 4 - 5 breaks: 4 tells 3, which tells 2, which tells 1.
TEST(Aodv, ABrokenLinkIsToldToAllWhoSendOverIt) {
  Network network(5, quiet());
  connect_chain(network);
  network.send(1, 5);
  network.run(2s);
  network.disconnect(4, 5);
  network.send(1, 5);
  network.run(100ms);
  for (const int number : {2, 3, 4}) {
    EXPECT_EQ(network.node(number).events[Event::kRerrSent], 1) << number;
    EXPECT_FALSE(route(network, number, 5)) << number;
  }
  EXPECT_EQ(network.node(1).events[Event::kRerrReceived], 1);
  EXPECT_FALSE(route(network, 1, 5));
  ASSERT_EQ(network.ends.size(), 2u);
  EXPECT_EQ(network.ends[1].verdict, Verdict::kRetryLimit);
  EXPECT_EQ(network.ends[1].node, id(4));
  network.connect(4, 5);
  network.send(1, 5);
  network.run(5s);
  EXPECT_EQ(network.node(5).messages.size(), 2u);
}

TEST(Aodv, ItsOwnMessageFindsAnotherWayWhenTheFirstHopBreaks) {
  Network network(4, quiet());
  for (const auto& [a, b] : {std::pair{1, 2}, {1, 3}, {2, 4}, {3, 4}}) network.connect(a, b);
  network.send(1, 4);
  network.run(2s);
  const int first = route(network, 1, 4)->next_hop.value;
  network.disconnect(1, first);
  network.send(1, 4);
  network.run(2s);
  EXPECT_EQ(network.node(4).messages.size(), 2u);
  EXPECT_EQ(route(network, 1, 4)->next_hop, id(5 - first));
  ASSERT_EQ(network.node(1).fates.size(), 2u);
  EXPECT_EQ(network.node(1).fates[1].fate, Fate::kHandedOver);
}

// 3 - 4 breaks; 3 - 6 - 7 - 5 leads round it.
TEST(Aodv, ARepairSavesTheMessageAndSparesTheSource) {
  for (const bool repairs : {true, false}) {
    Network network(7, with([&](AodvConfig& c) { c.local_repair = repairs; }));
    for (const auto& [a, b] : {std::pair{1, 2}, {2, 3}, {3, 4}, {4, 5}, {3, 6}, {6, 7}, {7, 5}}) {
      network.connect(a, b);
    }
    network.send(1, 5);
    network.run(2s);
    network.disconnect(3, 4);
    network.send(1, 5);
    network.run(1s);
    EXPECT_EQ(network.node(5).messages.size(), repairs ? 2u : 1u);
    EXPECT_EQ(network.node(3).events[Event::kLocalRepairDone], repairs ? 1 : 0);
    EXPECT_EQ(network.node(1).events[Event::kRerrReceived], repairs ? 0 : 1);
  }
}

TEST(Aodv, ARepairThatFindsNothingIsToldAsABreak) {
  Network network(5, with([](AodvConfig& c) { c.local_repair = true; }));
  connect_chain(network);
  network.send(1, 5);
  network.run(2s);
  network.disconnect(4, 5);
  network.send(1, 5);
  network.run(2s);
  EXPECT_EQ(network.node(4).events[Event::kLocalRepairFailed], 1);
  EXPECT_EQ(network.node(1).events[Event::kRerrReceived], 1);
  ASSERT_EQ(network.ends.size(), 2u);
  EXPECT_EQ(network.ends[1].verdict, Verdict::kNoRoute);
}

// 4 - 5 breaks; 4 - 6 - 7 - 8 - 5 leads round it, a hop too long for the repair.
TEST(Aodv, WhatTheRepairingNodeSendsItselfWaitsForASearchOfItsOwn) {
  Network network(8, with([](AodvConfig& c) { c.local_repair = true; }));
  for (const auto& [a, b] :
       {std::pair{1, 2}, {2, 3}, {3, 4}, {4, 5}, {4, 6}, {6, 7}, {7, 8}, {8, 5}}) {
    network.connect(a, b);
  }
  network.send(1, 5);
  network.run(2s);
  network.disconnect(4, 5);
  const MessageId of_other = network.send(1, 5);
  network.run(100ms);
  ASSERT_EQ(network.node(4).events[Event::kLocalRepairStarted], 1);
  network.send(4, 5);
  network.run(5s);
  EXPECT_EQ(network.node(4).events[Event::kLocalRepairFailed], 1);
  ASSERT_EQ(network.node(5).messages.size(), 2u);
  EXPECT_EQ(network.node(5).messages[1].source, id(4));
  const auto lost = std::ranges::find(network.ends, Verdict::kNoRoute, &EndRecord::verdict);
  ASSERT_NE(lost, network.ends.end());
  EXPECT_EQ(lost->sent_by, id(1));
  EXPECT_EQ(lost->id, of_other);
}

TEST(Aodv, NumbersRollOverWithoutHarm) {
  RoutingConfig config = quiet();
  config.first_sequence = 0xfffffffc;
  Network network(4, config);
  connect_chain(network);
  for (int i = 0; i < 8; ++i) {
    network.send(1, 4);
    network.send(4, 1);
    network.run(2s);
    network.disconnect(2, 3);  // the numbers grow
    network.send(1, 4);
    network.run(100ms);
    network.connect(2, 3);
    network.run(15s);
  }
  EXPECT_GE(network.node(4).messages.size(), 8u);
  EXPECT_GE(network.node(1).messages.size(), 8u);
}

TEST(Aodv, HellosTellOfANeighbourThatIsGoneWithoutTraffic) {
  Network network(3, with([](AodvConfig& c) { c.hello = true; }));
  connect_chain(network);
  for (int i = 0; i < 6; ++i) {
    network.send(1, 3);
    network.run(500ms);
  }
  network.disconnect(2, 3);
  network.run(4s);
  EXPECT_EQ(network.node(3).lost, std::vector<AgentId>{id(2)});
  EXPECT_GT(total(network, Event::kHelloSent), 4);
}

TEST(Aodv, NobodySendsHellosWhereNothingIsSent) {
  Network network(3, with([](AodvConfig& c) { c.hello = true; }));
  connect_chain(network);
  network.run(20s);
  EXPECT_TRUE(network.sent.empty());
}

TEST(Aodv, SendsNoMoreRequestsInASecondThanAllowed) {
  Network network(20, with([](AodvConfig& c) { c.rreq_ratelimit = 10; }));
  network.connect(1, 2);
  for (int to = 3; to <= 20; ++to) network.send(1, to);
  network.run(20s);
  std::vector<Time> sent;
  for (const SentFrame& frame : network.sent) {
    if (frame.from == id(1)) sent.push_back(frame.at);
  }
  ASSERT_GT(sent.size(), 60u);
  for (std::size_t i = 10; i < sent.size(); ++i) EXPECT_GE(sent[i] - sent[i - 10], 1s);
  EXPECT_GT(network.node(1).events[Event::kRreqDelayed], 0);
}

// 1 is heard by 2, but does not hear it: the way over 3 is found.
TEST(Aodv, ALinkThatCarriesOneWayOnlyIsLeftOut) {
  Network network(3, quiet());
  for (const auto& [a, b] : {std::pair{1, 2}, {1, 3}, {3, 2}}) network.connect(a, b);
  network.is_lost = [](AgentId from, AgentId to) { return from == id(2) && to == id(1); };
  network.send(1, 2);
  network.run(3s);
  EXPECT_EQ(network.node(2).messages.size(), 1u);
  EXPECT_EQ(network.node(2).events[Event::kRrepLost], 1);
  EXPECT_GT(network.node(2).events[Event::kRreqBlacklisted], 0);
  EXPECT_EQ(route(network, 1, 2)->next_hop, id(3));
}

TEST(Aodv, ANodeThatWaitsAfterItsStartAnswersNobody) {
  Network network(3, with([](AodvConfig& c) { c.wait_after_start = true; }));
  connect_chain(network);
  network.send(1, 3);
  network.run(8s);
  EXPECT_TRUE(network.sent.empty());
  network.run(9s);  // DELETE_PERIOD is 15 s
  network.send(1, 3);
  network.run(2s);
  EXPECT_EQ(network.node(3).messages.size(), 1u);
}

TEST(Aodv, InvalidatingARouteLooksForItAnew) {
  Network network(3, quiet());
  connect_chain(network);
  network.send(1, 3);
  network.run(2s);
  network.node(1).router->invalidate("help", id(3));
  EXPECT_FALSE(route(network, 1, 3));
  network.send(1, 3);
  network.run(2s);
  EXPECT_EQ(network.node(1).discoveries.size(), 2u);
  EXPECT_EQ(network.node(3).messages.size(), 2u);
}

TEST(Aodv, WorksOverALinkThatTellsNothing) {
  Network network(9, quiet(), 1, Network::kNothing);
  connect_grid(network, 3);
  for (int i = 0; i < 5; ++i) {
    network.send(1, 9);
    network.run(2s);
  }
  EXPECT_EQ(network.node(9).messages.size(), 5u);
}

TEST(Aodv, FloodsWhatIsForEveryone) {
  Network network(9, quiet());
  connect_grid(network, 3);
  network.flood(5);
  network.send(5, kNeighbours.value);
  network.run(2s);
  EXPECT_EQ(network.node(1).messages.size(), 1u);
  EXPECT_EQ(network.node(2).messages.size(), 2u);
  EXPECT_EQ(network.node(5).fates.size(), 2u);
}

TEST(Aodv, TellsARouteOfEachClassThatWasSeen) {
  Network network(3, quiet());
  connect_chain(network);
  network.send(1, 3, "help");
  network.run(2s);
  network.send(1, 3, "video");
  network.run(1s);
  EXPECT_EQ(network.node(1).discoveries.size(), 1u);
  const auto all = network.node(1).router->routes();
  const auto is_to_3 = [](const Route& r) { return r.destination == id(3); };
  EXPECT_EQ(std::ranges::count_if(all, is_to_3), 2);
}

}  // namespace
}  // namespace hal::node::routing::test
