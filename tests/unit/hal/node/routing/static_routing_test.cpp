#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::test {
namespace {

/// Routes along the chain 1 - 2 - … - n. Every node has the same table, so the network replaces
/// the routers by those that the tables of their nodes give.
class StaticChain : public testing::Test {
 protected:
  static std::vector<StaticRoute> along_chain(int self, int nodes) {
    std::vector<StaticRoute> routes;
    for (int to = 1; to <= nodes; ++to) {
      if (to == self) continue;
      const int hops = std::abs(to - self);
      routes.push_back(
          {id(to), id(to > self ? self + 1 : self - 1), static_cast<std::uint16_t>(hops)});
    }
    return routes;
  }

  static void give(Network& network, int number, std::vector<StaticRoute> routes) {
    RoutingConfig config{.algorithm = Algorithm::kStatic};
    config.statics.routes = std::move(routes);
    TestNode& node = network.node(number);
    node.router = std::make_unique<Router>(node.self, config, RouterStreams(1, "n"),
                                           RouterPorts{node, network.clock, node, node});
  }

  static void give_chain(Network& network) {
    for (int number = 1; number <= network.size(); ++number)
      give(network, number, along_chain(number, network.size()));
  }

  static std::vector<Verdict> verdicts(const Network& network) {
    std::vector<Verdict> all;
    for (const EndRecord& end : network.ends) all.push_back(end.verdict);
    return all;
  }
};

const RoutingConfig kStatic{.algorithm = Algorithm::kStatic};

TEST_F(StaticChain, PassesAMessageOnWithItsPriority) {
  Network network(4, kStatic);
  connect_chain(network);
  give_chain(network);
  network.send(1, 4, "help", Priority::kVideo);
  network.run(1s);
  ASSERT_EQ(network.node(4).messages.size(), 1u);
  EXPECT_EQ(network.node(4).messages[0].priority, Priority::kVideo);
  ASSERT_EQ(network.sent.size(), 3u);
  for (const auto& frame : network.sent) EXPECT_EQ(frame.priority, Priority::kVideo);
}

TEST_F(StaticChain, CarriesMessagesOverEveryNumberOfHopsBothWays) {
  for (const int nodes : {2, 5, 12}) {
    Network network(nodes, kStatic);
    connect_chain(network);
    give_chain(network);
    network.send(1, nodes);
    network.send(nodes, 1);
    network.run(1s);
    for (const int end : {1, nodes}) {
      ASSERT_EQ(network.node(end).messages.size(), 1u) << nodes;
      EXPECT_EQ(network.node(end).transmissions_of[0], nodes - 1);
      ASSERT_EQ(network.node(end).fates.size(), 1u);
      EXPECT_EQ(network.node(end).fates[0].fate, Fate::kHandedOver);
    }
    EXPECT_EQ(network.sent.size(), 2u * static_cast<unsigned>(nodes - 1)) << "no frame but data";
    EXPECT_EQ(network.ends.size(), 2u);
  }
}

TEST_F(StaticChain, EndsWithNoRouteWhereTheRouteIsMissing) {
  Network network(3, kStatic);
  connect_chain(network);
  give_chain(network);
  give(network, 1, {});
  network.send(1, 3);
  network.run(1s);
  ASSERT_EQ(verdicts(network), std::vector{Verdict::kNoRoute});
  EXPECT_EQ(network.ends[0].node, id(1));
  EXPECT_EQ(network.node(1).fates.at(0).fate, Fate::kNoRoute);

  give(network, 1, along_chain(1, 3));
  give(network, 2, {{id(1), id(1), 1}});
  network.send(1, 3);
  network.run(1s);
  ASSERT_EQ(network.ends.size(), 2u);
  EXPECT_EQ(network.ends[1].verdict, Verdict::kNoRoute);
  EXPECT_EQ(network.ends[1].node, id(2));
  EXPECT_EQ(network.node(1).fates.at(1).fate, Fate::kHandedOver) << "the first hop had it";
}

TEST_F(StaticChain, ANextHopThatDoesNotAnswerFailsAndTheRouteStays) {
  Network network(3, kStatic);
  connect_chain(network);
  give_chain(network);
  network.disconnect(2, 3);
  network.send(1, 3);
  network.run(1s);
  ASSERT_EQ(verdicts(network), std::vector{Verdict::kRetryLimit});
  EXPECT_EQ(network.ends[0].node, id(2));
  network.connect(2, 3);
  network.send(1, 3);
  network.run(1s);
  EXPECT_EQ(network.node(3).messages.size(), 1u);
}

/// There is a way over 2, but the route of 1 is via 4, which 1 does not hear.
TEST_F(StaticChain, AWrongNextHopIsNotReplacedByARightOne) {
  Network network(4, kStatic);
  connect_chain(network);
  give_chain(network);
  give(network, 1, {{id(3), id(4), 2}});
  network.send(1, 3);
  network.run(1s);
  EXPECT_EQ(verdicts(network), std::vector{Verdict::kRetryLimit});
  EXPECT_TRUE(network.node(3).messages.empty());
  EXPECT_EQ(network.node(1).fates.at(0).fate, Fate::kFailed);
}

TEST_F(StaticChain, TheVerdictOfTheLinkIsThatOfTheMessage) {
  Network network(2, kStatic);
  connect_chain(network);
  give_chain(network);
  network.refusal = [](AgentId) { return Verdict::kRadioOff; };
  network.send(1, 2);
  network.run(1s);
  EXPECT_EQ(verdicts(network), std::vector{Verdict::kRadioOff});
}

TEST_F(StaticChain, GoesNoFurtherThanTheHopLimit) {
  Network network(4, kStatic);
  connect_chain(network);
  for (int number = 1; number <= 4; ++number) {
    RoutingConfig config{.algorithm = Algorithm::kStatic, .hop_limit = 2};
    config.statics.routes = along_chain(number, 4);
    TestNode& node = network.node(number);
    node.router = std::make_unique<Router>(node.self, config, RouterStreams(1, "n"),
                                           RouterPorts{node, network.clock, node, node});
  }
  network.send(1, 3);
  network.send(1, 4);
  network.run(1s);
  EXPECT_EQ(network.node(3).messages.size(), 1u);
  EXPECT_TRUE(network.node(4).messages.empty());
  EXPECT_EQ(network.ends.back().verdict, Verdict::kExpired);
}

TEST_F(StaticChain, FloodsToEveryoneAndToTheNeighboursWithoutRoutes) {
  Network network(4, kStatic);
  connect_chain(network);
  network.flood(1);
  network.send(2, kNeighbours.value);
  network.run(20s);
  EXPECT_EQ(network.node(4).messages.size(), 1u);
  EXPECT_EQ(network.node(3).messages.size(), 2u);
}

TEST_F(StaticChain, ReportsItsRoutesOnceForEachClassItSees) {
  Network network(3, kStatic);
  connect_chain(network);
  give_chain(network);
  EXPECT_TRUE(network.node(1).changes.empty());
  network.send(1, 3, "a");
  network.send(1, 2, "a");
  network.run(1s);
  const TestNode& first = network.node(1);
  ASSERT_EQ(first.changes.size(), 2u);
  const Route expected{.topic = "a", .destination = id(3), .next_hop = id(2), .path = {.hops = 2}};
  EXPECT_EQ(first.changes[1].route, expected);
  EXPECT_EQ(first.router->routes("b", id(3)).at(0).next_hop, id(2));
  EXPECT_EQ(first.router->routes().size(), 2u);
  EXPECT_EQ(network.node(2).changes.size(), 2u) << "it relayed one";
  first.router->invalidate("a", id(3));
  EXPECT_EQ(first.router->routes("a", id(3)).size(), 1u);
}

/// Acknowledgements are lost: the message is repeated, and neither delivered nor relayed twice.
TEST_F(StaticChain, WorksOverALinkWithoutTransmitStatus) {
  Network network(3, kStatic, 1, Network::kNothing);
  connect_chain(network);
  give_chain(network);
  int count = 0;
  network.is_lost = [&count](AgentId from, AgentId) { return from != id(1) && ++count % 2 == 0; };
  for (int i = 0; i < 10; ++i) network.send(1, 3);
  network.run(5s);
  EXPECT_GT(network.node(3).messages.size(), 5u);
  std::vector<MessageId> ids;
  for (const Message& message : network.node(3).messages) ids.push_back(message.id);
  std::ranges::sort(ids);
  EXPECT_EQ(std::ranges::adjacent_find(ids), ids.end());
}

}  // namespace
}  // namespace hal::node::routing::test
