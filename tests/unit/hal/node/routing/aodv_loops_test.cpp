#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::test {
namespace {

constexpr int kNodes = 10;

/// Follows the next hops towards a destination from every node.
void expect_no_loop(Network& network, int to, int step) {
  for (int from = 1; from <= kNodes; ++from) {
    std::set<int> seen;
    int at = from;
    while (at != to) {
      if (!seen.insert(at).second) {
        ADD_FAILURE() << "step " << step << ": from " << from << " to " << to << " loops at " << at;
        return;
      }
      const auto routes = network.node(at).router->routes("help", id(to));
      if (routes.empty()) break;
      at = routes.front().next_hop.value;
    }
  }
}

/// What happens to a network at random.
class Trouble {
 public:
  Trouble(Network& network, const RoutingConfig& config, std::uint64_t seed)
      : network_(network), config_(config), random_(seed, "trouble") {}

  void step() {
    const int a = any();
    const int b = any();
    if (a == b) return;
    const double what = random_.uniform();
    if (what < 0.35) {
      network_.connect(a, b);
    } else if (what < 0.65) {
      network_.disconnect(a, b);
    } else if (what < 0.98) {
      network_.send(a, b);
    } else {
      restart(a);
    }
  }

  int any() { return 1 + static_cast<int>(random_.below(kNodes)); }
  Duration wait() { return Duration{static_cast<std::int64_t>(random_.uniform() * 4e8)}; }

 private:
  /// It forgets all it knew, its number too.
  void restart(int number) {
    TestNode& node = network_.node(number);
    RoutingConfig config = config_;
    config.aodv.wait_after_start = true;
    // Its packets must not pass for copies: as a real node's, they are numbered elsewhere.
    node.router.reset();
    node.router = std::make_unique<Router>(node.self, config, RouterStreams(++restarts_, "again"),
                                           RouterPorts{node, network_.clock, node, node});
  }

  Network& network_;
  RoutingConfig config_;
  RandomStream random_;
  std::uint64_t restarts_ = 1000;
};

/// Links come and go, nodes restart, frames get lost, and at no time does a packet find a circle.
void expect_freedom_from_loops(RoutingConfig config, std::uint64_t seed) {
  config.algorithm = Algorithm::kAodv;
  config.jitter_max = 10ms;
  Network network(kNodes, config, seed);
  connect_grid(network, 5);
  RandomStream loss(seed, "loss");
  network.is_lost = [&loss](AgentId, AgentId) { return loss.uniform() < 0.1; };
  Trouble trouble(network, config, seed);
  for (int step = 0; step < 400; ++step) {
    trouble.step();
    network.run(trouble.wait());
    for (int to = 1; to <= kNodes; ++to) expect_no_loop(network, to, step);
    if (testing::Test::HasFailure()) return;
  }
  std::size_t delivered = 0;
  for (int number = 1; number <= kNodes; ++number) {
    delivered += network.node(number).messages.size();
  }
  EXPECT_GT(delivered, 10u);
}

class AodvLoops : public testing::TestWithParam<int> {};

TEST_P(AodvLoops, NeverArise) {
  expect_freedom_from_loops({}, static_cast<std::uint64_t>(GetParam()));
}

TEST_P(AodvLoops, NeverAriseWithRepairsAndWithoutHellos) {
  RoutingConfig config;
  config.aodv.local_repair = true;
  config.aodv.hello = false;
  expect_freedom_from_loops(config, static_cast<std::uint64_t>(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Seeds, AodvLoops, testing::Range(1, 6));

// Nobody restarts here, so every message has a sender that is told of it.
TEST(AodvMessages, EachHasOneFateAndArrivesAtMostOnce) {
  RoutingConfig config{.algorithm = Algorithm::kAodv, .jitter_max = 10ms};
  Network network(kNodes, config, 3);
  connect_grid(network, 5);
  RandomStream random(3, "loss");
  network.is_lost = [&random](AgentId, AgentId) { return random.uniform() < 0.2; };
  for (int i = 0; i < 200; ++i) {
    network.send(1 + i % 9, 10);
    network.run(100ms);
    if (i % 20 == 10) network.disconnect(5, 10);
    if (i % 20 == 0) network.connect(5, 10);
  }
  network.run(60s);
  for (int number = 1; number <= kNodes; ++number) {
    std::map<MessageId, int> fates;
    for (const FateRecord& fate : network.node(number).fates) ++fates[fate.id];
    EXPECT_EQ(fates.size(), network.node(number).last_id) << number;
    for (const auto& [message, count] : fates) EXPECT_EQ(count, 1) << number << "/" << message;
  }
  std::map<std::pair<AgentId, MessageId>, int> arrivals;
  for (const Message& message : network.node(10).messages) ++arrivals[{message.source, message.id}];
  for (const auto& [message, count] : arrivals) EXPECT_EQ(count, 1);
  EXPECT_GT(arrivals.size(), 50u);
}

}  // namespace
}  // namespace hal::node::routing::test
