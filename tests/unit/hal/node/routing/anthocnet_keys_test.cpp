#include <gtest/gtest.h>

#include <set>

#include "tests/unit/hal/node/routing/anthocnet_network.h"

// Each parameter of path setup and pheromone shows its effect. Those of proactive ants are tried in
// anthocnet_proactive_test.cpp, those of repair in anthocnet_failure_test.cpp.
namespace hal::node::routing::anthocnet::test {
namespace {

RoutingConfig with(double AntHocNetConfig::*key, double value) {
  RoutingConfig config = ant_config();
  config.anthocnet.*key = value;
  return config;
}

/// Of 100 networks 1 - {2, 3 - 5} - 4: those where, after both ways are known, `goes` says that the
/// longer one was taken.
template <class Goes>
int longer_ways(RoutingConfig config, Goes goes) {
  config.anthocnet.acceptance_new_first_hop = 5;
  config.anthocnet.proactive_margin = 0;
  config.anthocnet.proactive_broadcast_probability = 0;
  int longer = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Network network(6, config, seed);
    for (const auto& [a, b] : {std::pair{1, 2}, {2, 4}, {1, 3}, {3, 5}, {5, 4}}) {
      network.connect(a, b);
    }
    network.send(1, 4);
    network.run(100ms);
    EXPECT_EQ(network.node(1).router->routes("help", id(4)).size(), 2u);
    network.sent.clear();
    longer += goes(network);
  }
  return longer;
}

bool data_goes_over_3(Network& network) {
  network.send(1, 4);
  network.run(100ms);
  return network.sent.front().to == routing::test::id(3);
}

/// Node 6 joins and looks for 4: node 1 picks the way of its ant.
bool reactive_ant_goes_over_3(Network& network) {
  network.connect(6, 1);
  network.send(6, 4);
  network.run(100ms);
  for (const auto& [frame, ant] : forward_ants(network, AntKind::kReactive)) {
    if (frame.from == routing::test::id(1)) return frame.to == routing::test::id(3);
  }
  ADD_FAILURE() << "the ant did not come";
  return false;
}

bool proactive_ant_goes_over_3(Network& network) {
  network.run(2s);
  for (const auto& [frame, ant] : forward_ants(network, AntKind::kProactive)) {
    if (frame.from == routing::test::id(1)) return frame.to == routing::test::id(3);
  }
  ADD_FAILURE() << "no ant left";
  return false;
}

// Pheromone of 2 and 3 hops is as 3 to 2. Binomial, 100 draws: four standard deviations are at
// most 20.
TEST(AntHocNetKeys, BetaDataPrefersTheBetterWay) {
  EXPECT_NEAR(longer_ways(with(&AntHocNetConfig::beta_data, 0), data_goes_over_3), 50, 20);
  EXPECT_NEAR(longer_ways(with(&AntHocNetConfig::beta_data, 2), data_goes_over_3), 31, 20);
  EXPECT_LE(longer_ways(with(&AntHocNetConfig::beta_data, 20), data_goes_over_3), 2);
}

TEST(AntHocNetKeys, BetaReactivePrefersTheBetterWay) {
  const auto key = &AntHocNetConfig::beta_reactive;
  EXPECT_NEAR(longer_ways(with(key, 0), reactive_ant_goes_over_3), 50, 20);
  EXPECT_LE(longer_ways(with(key, 20), reactive_ant_goes_over_3), 2);
}

TEST(AntHocNetKeys, BetaProactivePrefersTheBetterWay) {
  const auto key = &AntHocNetConfig::beta_proactive;
  EXPECT_NEAR(longer_ways(with(key, 0), proactive_ant_goes_over_3), 50, 20);
  EXPECT_LE(longer_ways(with(key, 20), proactive_ant_goes_over_3), 2);
}

std::size_t ways_of_diamond(double band) {
  Network network(4, with(&AntHocNetConfig::acceptance_new_first_hop, band));
  connect_diamond(network);
  network.send(1, 4);
  network.run(1s);
  return network.node(1).router->routes("help", routing::test::id(4)).size();
}

TEST(AntHocNetKeys, AcceptanceNewFirstHopLetsCopiesInFromElsewhere) {
  EXPECT_EQ(ways_of_diamond(2), 2u);
  EXPECT_EQ(ways_of_diamond(0.5), 1u);
}

/// 1 - 2 - {3, 4} - 5: the copies share their first hop.
std::size_t ways_behind_2(double band) {
  Network network(5, with(&AntHocNetConfig::acceptance, band));
  for (const auto& [a, b] : {std::pair{1, 2}, {2, 3}, {2, 4}, {3, 5}, {4, 5}}) {
    network.connect(a, b);
  }
  network.send(1, 5);
  network.run(1s);
  return network.node(2).router->routes("help", routing::test::id(5)).size();
}

TEST(AntHocNetKeys, AcceptanceLetsCopiesInFromTheSameFirstHop) {
  EXPECT_EQ(ways_behind_2(0.9), 1u);
  EXPECT_EQ(ways_behind_2(1.5), 2u);
}

std::size_t ants_in_a_crowd(int copies) {
  RoutingConfig config = ant_config();
  config.anthocnet.copies = copies;
  Network network(10, config);
  for (int a = 1; a <= 9; ++a) {
    for (int b = a + 1; b <= 9; ++b) network.connect(a, b);
  }
  network.connect(9, 10);
  network.send(1, 10);
  network.run(500ms);
  EXPECT_EQ(network.node(10).messages.size(), 1u);
  return forward_ants(network, AntKind::kReactive).size();
}

TEST(AntHocNetKeys, CopiesBoundTheFlood) {
  EXPECT_LE(ants_in_a_crowd(1), 10u) << "each node but the last, once";
  EXPECT_GT(ants_in_a_crowd(4), 20u);
}

/// The delay of the path 1 - 2 - 3 that a second search finds after ten messages.
Duration second_delay(const RoutingConfig& config) {
  Network network(3, config);
  routing::test::connect_chain(network);
  network.send(1, 3);
  network.run(100ms);
  for (int i = 0; i < 10; ++i) {
    network.send(1, 3);
    network.run(10ms);
  }
  network.node(1).router->invalidate("help", routing::test::id(3));
  network.node(2).router->invalidate("help", routing::test::id(3));
  network.send(1, 3);
  network.run(100ms);
  return network.node(1).router->routes("help", routing::test::id(3)).at(0).path.delay;
}

// A frame takes 1 ms on this medium.
TEST(AntHocNetKeys, MacWeightKeepsThePast) {
  EXPECT_EQ(second_delay(with(&AntHocNetConfig::mac_weight, 1)), 6ms) << "T_hop for ever";
  EXPECT_EQ(second_delay(with(&AntHocNetConfig::mac_weight, 0)), 2ms);
  const Duration between = second_delay(with(&AntHocNetConfig::mac_weight, 0.9));
  EXPECT_GT(between, 2ms);
  EXPECT_LT(between, 6ms);
}

/// What node 1's hellos tell of node 3, which is two hops away, the first and the last time.
std::pair<double, double> told(const RoutingConfig& config) {
  Network network(3, config);
  routing::test::connect_chain(network);
  network.send(1, 3);
  for (int i = 0; i < 20; ++i) {
    network.run(300ms);
    network.send(1, 3);
  }
  std::vector<double> pheromone;
  for (const auto& [frame, hello] : sent_packets<PheromoneHello>(network)) {
    for (const Scent& scent : hello.scents) {
      if (frame.from == routing::test::id(1) && scent.target.destination == routing::test::id(3)) {
        pheromone.push_back(scent.pheromone);
      }
    }
  }
  EXPECT_GE(pheromone.size(), 4u);
  return {pheromone.front(), pheromone.back()};
}

// The hops become faster than T_hop, so that pheromone grows from sample to sample.
TEST(AntHocNetKeys, PheromoneWeightKeepsThePast) {
  const auto [first, last] = told(with(&AntHocNetConfig::pheromone_weight, 1));
  EXPECT_DOUBLE_EQ(last, first);
  const auto [before, after] = told(with(&AntHocNetConfig::pheromone_weight, 0));
  EXPECT_GT(after, 1.1 * before);
}

// Pheromone is 2 / (T + h T_hop).
TEST(AntHocNetKeys, HopTimeIsWhatAHopCosts) {
  RoutingConfig config = with(&AntHocNetConfig::pheromone_weight, 1);
  config.anthocnet.hop_time = 10ms;
  const double slow = told(config).first;
  config.anthocnet.hop_time = 3ms;
  EXPECT_GT(told(config).first, 2 * slow);
  EXPECT_EQ(second_delay(with(&AntHocNetConfig::mac_weight, 1)), 6ms);
}

}  // namespace
}  // namespace hal::node::routing::anthocnet::test
