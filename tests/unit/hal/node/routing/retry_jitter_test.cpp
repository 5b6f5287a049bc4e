#include <gtest/gtest.h>

#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::test {
namespace {

/// When node 1 sent its ants in vain.
std::vector<Duration> tries_of(const RoutingConfig& config, std::uint64_t seed, int node = 1) {
  Network network(2, config, seed);
  network.send(node, 3 - node);
  network.run(60s);
  std::vector<Duration> times;
  for (const SentFrame& frame : network.sent) times.push_back(frame.at.time_since_epoch());
  EXPECT_EQ(network.node(node).discoveries.size(), 1u);
  times.push_back(network.node(node).discoveries.at(0).took);
  return times;
}

TEST(RetryJitter, RetriesComeEarlyByARandomShareOfThePeriod) {
  double total = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const auto tries = tries_of({.retry_jitter = 0.4}, seed);
    ASSERT_EQ(tries.size(), 4u);  // retries = 3 in all, and the end
    EXPECT_EQ(tries[0], 0s) << "the first one leaves at once";
    for (const int i : {1, 2}) {
      EXPECT_GT(tries[i] - tries[i - 1], 3s);
      EXPECT_LE(tries[i] - tries[i - 1], 5s);
      total += to_seconds(tries[i] - tries[i - 1]);
    }
    EXPECT_EQ(tries[3] - tries[2], 5s) << "no try follows";
  }
  // 5 s less U(0, 2 s), 400 times: standard error 2 / sqrt(12 * 400) = 0.029 s; 4 of them.
  EXPECT_NEAR(total / 400, 4, 0.116);
}

TEST(RetryJitter, NodesThatBeganTogetherComeApart) {
  EXPECT_EQ(tries_of({.retry_jitter = 0}, 1, 1), tries_of({.retry_jitter = 0}, 1, 2));
  const auto one = tries_of({}, 1, 1);
  const auto other = tries_of({}, 1, 2);
  EXPECT_EQ(one[0], other[0]);
  EXPECT_NE(one[1], other[1]);
  EXPECT_NE(one[2], other[2]);
}

// Node 2 relays a flood after two retries of its own: their jitter is not drawn from the relay's
// stream.
TEST(RetryJitter, TheJitterOfRetriesShiftsNothingElse) {
  const auto relayed_at = [](double retry_jitter) {
    Network network(3, {.retry_jitter = retry_jitter});
    network.send(2, 3);
    network.run(30s);
    network.connect(1, 2);
    network.flood(1);
    network.run(1s);
    EXPECT_EQ(network.sent.back().from, id(2));
    return network.sent.back().at;
  };
  EXPECT_EQ(relayed_at(0), relayed_at(0.5));
}

}  // namespace
}  // namespace hal::node::routing::test
