#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::test {
namespace {

struct Outcome {
  std::vector<SentFrame> sent;
  int messages = 0;
  int delivered = 0;
};

void expect_each_fate_once(Network& network) {
  for (int number = 1; number <= network.size(); ++number) {
    std::map<MessageId, int> fates;
    for (const FateRecord& fate : network.node(number).fates) ++fates[fate.id];
    EXPECT_EQ(fates.size(), network.node(number).last_id) << "node " << number;
    for (const auto& [message, count] : fates) EXPECT_EQ(count, 1) << number << '/' << message;
  }
}

void expect_no_message_twice(Network& network) {
  for (int number = 1; number <= network.size(); ++number) {
    std::set<std::pair<AgentId, MessageId>> seen;
    for (const Message& message : network.node(number).messages) {
      EXPECT_TRUE(seen.insert({message.source, message.id}).second) << "node " << number;
    }
  }
}

/// One random act in a 4 x 4 grid: a message or flood, now and then an invalidation, and a link
/// between two neighbours in a row that breaks or mends.
void act(Network& network, RandomStream& random) {
  const int from = 1 + static_cast<int>(random.below(16));
  const int to = 1 + (from + static_cast<int>(random.below(15))) % 16;
  if (random.below(10) == 0) {
    network.flood(from);
  } else if (from != to) {
    network.send(from, to, random.below(2) == 0 ? "help" : "audio");
  }
  if (random.below(5) == 0) network.node(from).router->invalidate("help", id(to));
  const int edge = 1 + static_cast<int>(random.below(15));
  if (edge % 4 == 0) return;
  if (random.below(2) == 0) {
    network.disconnect(edge, edge + 1);
  } else {
    network.connect(edge, edge + 1);
  }
}

/// Every reception is lost with probability `loss`; 2 % of the frames are refused by the link,
/// which says so if it can.
Outcome run_random(std::uint64_t seed, double loss, LinkCapabilities link) {
  const RoutingConfig config{.retry_period = 200ms,
                             .buffer_limit = 4,
                             .buffer_age = 500ms,
                             .ack_timeout = 5ms,
                             .hello_period = 500ms};
  Network network(16, config, seed, link);
  connect_grid(network, 4);
  RandomStream random(seed, "medium");
  network.is_lost = [&](AgentId, AgentId) { return random.uniform() < loss; };
  network.refusal = [&](AgentId) -> std::optional<Verdict> {
    if (random.uniform() > 0.02) return std::nullopt;
    return random.below(2) == 0 ? Verdict::kQueueFull : Verdict::kRadioOff;
  };
  for (int round = 0; round < 150; ++round) {
    act(network, random);
    network.run(std::chrono::milliseconds{random.below(40)});
  }
  network.run(60s);
  expect_each_fate_once(network);
  expect_no_message_twice(network);
  Outcome outcome{.sent = network.sent};
  for (int number = 1; number <= 16; ++number) {
    outcome.messages += static_cast<int>(network.node(number).last_id);
    outcome.delivered += static_cast<int>(network.node(number).messages.size());
    EXPECT_EQ(network.node(number).router->malformed_frames(), 0u);
  }
  return outcome;
}

/// Parameters: loss in percent; whether the link tells what becomes of its frames.
class RandomLoss : public testing::TestWithParam<std::tuple<int, bool>> {};

TEST_P(RandomLoss, EveryMessageHasOneFateAndArrivesAtMostOnce) {
  const auto [percent, link_tells] = GetParam();
  const LinkCapabilities link = link_tells ? Network::kEverything : Network::kNothing;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Outcome outcome = run_random(seed, percent / 100.0, link);
    if (percent <= 10) {
      EXPECT_GT(outcome.delivered, outcome.messages / 2);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Percent, RandomLoss,
                         testing::Combine(testing::Values(0, 10, 30, 60), testing::Bool()));

TEST(RandomTraffic, TheSameSeedGivesTheSameFrames) {
  for (const LinkCapabilities link : {Network::kEverything, Network::kNothing}) {
    const Outcome first = run_random(7, 0.2, link);
    const Outcome second = run_random(7, 0.2, link);
    ASSERT_EQ(first.sent.size(), second.sent.size());
    for (std::size_t i = 0; i < first.sent.size(); ++i) {
      ASSERT_EQ(first.sent[i].at, second.sent[i].at) << i;
      ASSERT_EQ(first.sent[i].bytes, second.sent[i].bytes) << i;
    }
  }
}

TEST(RandomTraffic, WithoutLossEverythingArrives) {
  Network network(16);
  connect_grid(network, 4);
  RandomStream random(3, "traffic");
  for (int round = 0; round < 200; ++round) {
    const int from = 1 + static_cast<int>(random.below(16));
    const int to = 1 + (from + static_cast<int>(random.below(15))) % 16;
    network.send(from, from == to ? 1 + to % 16 : to);
    network.run(20ms);
  }
  network.run(30s);
  int delivered = 0;
  for (int number = 1; number <= 16; ++number) {
    delivered += static_cast<int>(network.node(number).messages.size());
  }
  EXPECT_EQ(delivered, 200);
}

}  // namespace
}  // namespace hal::node::routing::test
