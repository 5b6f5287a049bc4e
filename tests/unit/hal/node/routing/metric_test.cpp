#include <gtest/gtest.h>

#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::test {
namespace {

/// Four ways from 1 to 10, each the best in one statistic:
///
///   over 2          fewest hops
///   over 3 and 4    strong links
///   over 5 and 6    quick nodes
///   over 7 and 8    nodes that need little energy
const std::map<PathStatistic, int> kBestWay{{PathStatistic::kHops, 2},
                                            {PathStatistic::kMinSnr, 3},
                                            {PathStatistic::kDelay, 5},
                                            {PathStatistic::kEnergy, 7}};

void build_ways(Network& network) {
  network.connect(1, 2);
  network.connect(2, 10);
  for (const int first : {3, 5, 7}) {
    network.connect(1, first);
    network.connect(first, first + 1);
    network.connect(first + 1, 10);
  }
  network.delay_of = [](AgentId node) {
    return node == id(5) || node == id(6) || node == id(1) ? Duration{100us} : Duration{20ms};
  };
  network.energy_of = [](AgentId node) {
    return node == id(7) || node == id(8) || node == id(1) ? 0.01 : 10.0;
  };
  network.snr_db = [](AgentId from, AgentId to) {
    const auto is_strong = [](AgentId node) { return node == id(3) || node == id(4); };
    return is_strong(from) || is_strong(to) ? 40.0 : 3.0;
  };
}

RoutingConfig with(const PathMetric& metric) {
  RoutingConfig config;
  config.jitter_max = Duration::zero();
  config.choice = {.metric = metric, .beta = 4};
  config.acceptance = 2;
  return config;
}

/// How many of 200 messages took each first hop.
std::map<int, int> shares(Network& network, const std::string& topic) {
  network.send(1, 10, topic);
  network.run(10s);
  const std::size_t before = network.sent.size();
  for (int i = 0; i < 200; ++i) network.send(1, 10, topic);
  network.run(10s);
  std::map<int, int> counts;
  for (std::size_t i = before; i < network.sent.size(); ++i) {
    if (network.sent[i].from == id(1)) ++counts[network.sent[i].to.value];
  }
  return counts;
}

TEST(MetricOfRouting, EachStatisticPrefersAWayOfItsOwn) {
  for (const auto& [statistic, way] : kBestWay) {
    Network network(10, with(path_metric(statistic)));
    build_ways(network);
    // 1/2 hop against three times 1/3, to the fourth: 126 are expected, of the others 25 each.
    EXPECT_GT(shares(network, "help")[way], 100) << name(statistic);
  }
}

// Over a link without transmit status the tuple is measured as well, but for the signal strength.
TEST(MetricOfRouting, WorksOverALinkWithoutTransmitStatus) {
  for (const auto& [statistic, way] : kBestWay) {
    if (statistic == PathStatistic::kMinSnr) continue;
    Network network(10, with(path_metric(statistic)), 1, Network::kNothing);
    build_ways(network);
    network.send(1, 10);
    network.run(5s);
    std::map<int, PathStatistics> paths;
    for (const Route& r : network.node(1).router->routes("help", id(10))) {
      paths[r.next_hop.value] = r.path;
    }
    ASSERT_EQ(paths.size(), 4u);
    for (const auto& [next_hop, path] : paths) {
      if (next_hop == way) continue;
      EXPECT_GT(path_value(path_metric(statistic), paths[way], false),
                path_value(path_metric(statistic), path, false))
          << name(statistic) << " over " << next_hop;
    }
  }
}

TEST(MetricOfRouting, AClassMayHaveOneOfItsOwn) {
  RoutingConfig config = with(path_metric(PathStatistic::kHops));
  config.classes["video"] = {.metric = path_metric(PathStatistic::kDelay), .beta = 4};
  Network network(10, config);
  build_ways(network);
  EXPECT_GT(shares(network, "help")[2], 100);
  EXPECT_GT(shares(network, "video")[5], 140);
}

// Hops alone prefer 2, delay alone 5; together 5 loses to neither. 2: 1/2 * 1/(20.1 ms); 5: 1/3 *
// 1/(0.3 ms).
TEST(MetricOfRouting, AProductWeighsBoth) {
  Network network(10, with({.hops = 1, .delay = 0.5}));
  build_ways(network);
  EXPECT_GT(shares(network, "help")[5], 140);
  Network other(10, with({.hops = 3, .delay = 0.05}));
  build_ways(other);
  EXPECT_GT(shares(other, "help")[2], 140);
}

}  // namespace
}  // namespace hal::node::routing::test
