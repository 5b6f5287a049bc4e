#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/unit/hal/node/routing/anthocnet_network.h"

namespace hal::node::routing::anthocnet::test {
namespace {

/// A message every 500 ms.
void keep_talking(Network& network, int from, int to, Duration span) {
  const Time end = network.clock.now() + span;
  while (network.clock.now() < end) {
    network.send(from, to);
    network.run(500ms);
  }
}

/// 1 - 2 - 5 - 6 - 4, with node 3 aside; then 1 - 3 - 4 comes up.
void find_the_long_way(Network& network) {
  for (const auto& [a, b] : {std::pair{1, 2}, {2, 5}, {5, 6}, {6, 4}}) network.connect(a, b);
  network.run(2s);
  network.send(1, 4);
  network.run(500ms);
  network.connect(1, 3);
  network.connect(3, 4);
}

TEST(AntHocNetProactive, DiffusionAndAProactiveAntFindABetterPath) {
  Network network(6, ant_config());
  find_the_long_way(network);
  keep_talking(network, 1, 4, 15s);
  std::uint16_t fewest = 99;
  for (const Route& route : network.node(1).router->routes("help", routing::test::id(4))) {
    fewest = std::min(fewest, route.path.hops);
  }
  EXPECT_EQ(fewest, 2);
  EXPECT_GE(events(network, ProtocolEvent::kProactiveAntSent), 1);
  EXPECT_EQ(events(network, ProtocolEvent::kForwardAntSent), 1) << "no second reactive search";
}

TEST(AntHocNetProactive, WithoutProactiveAntsTheLongWayStays) {
  RoutingConfig config = ant_config();
  config.anthocnet.proactive_period = 0ns;
  Network network(6, config);
  find_the_long_way(network);
  keep_talking(network, 1, 4, 15s);
  const auto routes = network.node(1).router->routes("help", routing::test::id(4));
  ASSERT_EQ(routes.size(), 1u);
  EXPECT_EQ(routes[0].next_hop, id(2));
  EXPECT_EQ(events(network, ProtocolEvent::kProactiveAntSent), 0);
}

TEST(AntHocNetProactive, WithoutDiffusionNothingPromisesABetterPath) {
  RoutingConfig config = ant_config();
  config.anthocnet.hello_destinations = 0;
  Network network(6, config);
  find_the_long_way(network);
  keep_talking(network, 1, 4, 15s);
  EXPECT_EQ(network.node(1).router->routes("help", id(4)).size(), 1u);
  EXPECT_EQ(events(network, ProtocolEvent::kProactiveAntSent), 0);
  for (const auto& [frame, hello] : sent_packets<PheromoneHello>(network)) {
    EXPECT_TRUE(hello.scents.empty());
  }
}

// Node 1 knows 4 only from hellos: that is enough for a proactive ant, not for a message.
TEST(AntHocNetProactive, VirtualPheromoneCarriesNoMessage) {
  Network network(4, ant_config());
  for (const auto& [a, b] : {std::pair{2, 3}, {3, 4}}) network.connect(a, b);
  network.send(2, 4);
  network.run(1s);
  network.connect(1, 2);
  network.run(3s);
  EXPECT_GT(network.node(1).events[ProtocolEvent::kPheromoneBootstrapped], 0);
  EXPECT_TRUE(network.node(1).router->routes().empty());
  network.sent.clear();
  network.send(1, 4);
  ASSERT_FALSE(network.sent.empty());
  const auto first = control_in(network.sent.front());
  ASSERT_TRUE(first && std::holds_alternative<ForwardAnt>(*first)) << "a search comes first";
  network.run(1s);
  EXPECT_EQ(network.node(4).messages.size(), 2u);
}

TEST(AntHocNetProactive, AHelloNamesAsManyTargetsAsItMay) {
  RoutingConfig config = ant_config();
  config.anthocnet.hello_destinations = 3;
  Network network(8, config);
  for (int number = 2; number <= 8; ++number) network.connect(1, number);
  for (int number = 3; number <= 8; ++number) network.send(2, number);
  network.run(10s);
  std::size_t most = 0;
  std::set<AgentId> named;
  for (const auto& [frame, hello] : sent_packets<PheromoneHello>(network)) {
    most = std::max(most, hello.scents.size());
    if (frame.from != routing::test::id(2)) continue;
    for (const Scent& scent : hello.scents) named.insert(scent.target.destination);
  }
  EXPECT_EQ(most, 3u);
  EXPECT_GE(named.size(), 5u) << "drawn anew each time";
}

/// Proactive ants in `span` on a path that diffusion cannot better, by config.
int proactive_ants(RoutingConfig config, Duration talk, Duration silence) {
  Network network(4, config);
  routing::test::connect_chain(network);
  keep_talking(network, 1, 4, talk);
  network.run(silence);
  return events(network, ProtocolEvent::kProactiveAntSent);
}

TEST(AntHocNetProactive, AMarginOfNoneSendsThemAlways) {
  RoutingConfig config = ant_config();
  EXPECT_EQ(proactive_ants(config, 20s, 0s), 0) << "there is but one way";
  config.anthocnet.proactive_margin = 0;
  const int ants = proactive_ants(config, 20s, 0s);
  EXPECT_GE(ants, 9);  // each wait is 1.5..2 s
  EXPECT_LE(ants, 13);
  config.anthocnet.proactive_period = 500ms;
  EXPECT_GE(proactive_ants(config, 20s, 0s), 38);
}

TEST(AntHocNetProactive, ASessionEndsAfterItsTimeout) {
  RoutingConfig config = ant_config();
  config.anthocnet.proactive_margin = 0;
  config.anthocnet.session_timeout = 4s;
  const int brief = proactive_ants(config, 2s, 60s);
  config.anthocnet.session_timeout = 20s;
  const int lasting = proactive_ants(config, 2s, 60s);
  EXPECT_LE(brief, 4);
  EXPECT_GE(lasting, 9);
}

/// Broadcasts of proactive ants.
int proactive_broadcasts(double probability, int budget) {
  RoutingConfig config = ant_config();
  config.anthocnet.proactive_margin = 0;
  config.anthocnet.proactive_broadcast_probability = probability;
  config.anthocnet.proactive_broadcasts = budget;
  Network network(6, config);
  routing::test::connect_chain(network);
  keep_talking(network, 1, 6, 20s);
  int broadcasts = 0;
  for (const auto& [frame, ant] : forward_ants(network, AntKind::kProactive)) {
    broadcasts += frame.to == kEveryone;
    EXPECT_LE(ant.broadcasts, budget);
  }
  return broadcasts;
}

TEST(AntHocNetProactive, ExploreByBroadcastsWithinTheirBudget) {
  EXPECT_EQ(proactive_broadcasts(0, 2), 0);
  EXPECT_GT(proactive_broadcasts(0.3, 2), 0);
  const int one = proactive_broadcasts(1, 1);
  const int three = proactive_broadcasts(1, 3);
  EXPECT_GT(one, 0);
  EXPECT_GT(three, 2 * one) << "each goes on after its first hop";
}

}  // namespace
}  // namespace hal::node::routing::anthocnet::test
