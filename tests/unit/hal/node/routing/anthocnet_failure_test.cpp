#include <gtest/gtest.h>

#include <map>

#include "hal/types/random.h"
#include "tests/unit/hal/node/routing/anthocnet_network.h"

namespace hal::node::routing::anthocnet::test {
namespace {

TEST(AntHocNetFailure, SendsAMessageOverAnotherTrailIfTheNextHopDoesNotAnswer) {
  Network network(4, ant_config());
  connect_diamond(network);
  network.send(1, 4);
  network.run(1s);
  network.disconnect(1, 2);
  for (int i = 0; i < 10; ++i) network.send(1, 4);
  network.run(100ms);
  EXPECT_EQ(network.node(4).messages.size(), 11u);
  EXPECT_EQ(network.node(1).discoveries.size(), 1u) << "no new search";
  EXPECT_GE(events(network, ProtocolEvent::kMessageSalvaged), 1);
}

// 1 - 2 - 3 - 5, and round the break 2 - 4 - 5: 2 repairs, the source hears nothing of it.
TEST(AntHocNetFailure, ARelayRepairsUnderAMessage) {
  Network network(5, ant_config());
  for (const auto& [a, b] : {std::pair{1, 2}, {2, 3}, {3, 5}}) network.connect(a, b);
  network.send(1, 5);
  network.run(200ms);
  network.connect(2, 4);
  network.connect(4, 5);
  network.disconnect(2, 3);
  network.send(1, 5);
  network.run(200ms);
  EXPECT_EQ(network.node(5).messages.size(), 2u);
  EXPECT_EQ(events(network, ProtocolEvent::kRepairAntSent), 1);
  EXPECT_EQ(events(network, ProtocolEvent::kRepairSucceeded), 1);
  EXPECT_EQ(network.node(1).discoveries.size(), 1u);
}

TEST(AntHocNetFailure, WithoutRepairTheMessageEndsAndTheSenderIsWarned) {
  RoutingConfig config = ant_config();
  config.anthocnet.repair_broadcasts = 0;
  Network network(4, config);
  routing::test::connect_chain(network);
  network.send(1, 4);
  network.run(200ms);
  network.disconnect(3, 4);
  network.send(1, 4);
  network.run(200ms);
  EXPECT_EQ(events(network, ProtocolEvent::kRepairAntSent), 0);
  EXPECT_EQ(network.ends.back().verdict, Verdict::kRetryLimit);
  EXPECT_EQ(events(network, ProtocolEvent::kWarningSent), 1);
  EXPECT_EQ(events(network, ProtocolEvent::kWarningReceived), 1);
  EXPECT_TRUE(network.node(1).router->routes("help", id(4)).empty())
      << "notices came to the source";
}

// The lost path 3 - 4 was one hop of T_mac: 3 ms at first, then measured. With a factor of 1000
// the message waits for seconds, with 1 it ends at once.
TEST(AntHocNetFailure, ARepairIsWaitedForAsLongAsTheLostPathSays) {
  const auto end_after = [](double factor) {
    RoutingConfig config = ant_config();
    config.anthocnet.repair_wait = factor;
    Network network(4, config);
    routing::test::connect_chain(network);
    network.send(1, 4);
    network.run(200ms);
    network.disconnect(3, 4);
    const Time sent = network.clock.now();
    network.send(1, 4);
    network.run(8s);
    EXPECT_EQ(network.ends.size(), 2u);
    EXPECT_EQ(network.ends.back().node, id(3));
    EXPECT_EQ(network.ends.back().verdict, Verdict::kNoRoute);
    return network.ends.back().at - sent;
  };
  EXPECT_LT(end_after(1), 20ms);
  EXPECT_GT(end_after(1000), 1s);
}

// Behind 3 is nothing but 4. When that is gone, 3 tells 2, whose only way it was, and 2 tells 1.
TEST(AntHocNetFailure, NoticesRunBackToTheSource) {
  Network network(4, ant_config());
  routing::test::connect_chain(network);
  network.send(1, 4);
  network.run(1s);
  network.disconnect(3, 4);
  network.run(5s);  // 3 misses the hellos of 4
  EXPECT_EQ(network.node(3).lost, std::vector{id(4)});
  for (int number = 1; number <= 3; ++number) {
    EXPECT_TRUE(network.node(number).router->routes("help", id(4)).empty()) << number;
  }
  EXPECT_GE(events(network, ProtocolEvent::kLossNoticeSent), 3);
}

// 2 loses its short way to 6 (2 - 3 - 6) and keeps the long one (2 - 4 - 5 - 6): it tells 1 the new
// length.
TEST(AntHocNetFailure, ANoticeCarriesTheBestThatIsLeft) {
  RoutingConfig config = ant_config();
  config.anthocnet.acceptance_new_first_hop = 5;
  config.anthocnet.acceptance = 5;
  config.anthocnet.proactive_period = 0ns;
  Network network(6, config);
  for (const auto& [a, b] : {std::pair{1, 2}, {2, 3}, {3, 6}, {2, 4}, {4, 5}, {5, 6}}) {
    network.connect(a, b);
  }
  network.send(1, 6);
  network.run(500ms);
  ASSERT_EQ(network.node(2).router->routes("help", id(6)).size(), 2u);
  network.disconnect(2, 3);
  network.run(5s);
  const auto routes = network.node(1).router->routes("help", routing::test::id(6));
  ASSERT_EQ(routes.size(), 1u);
  EXPECT_EQ(routes[0].path.hops, 4);
  bool is_told = false;
  for (const auto& [frame, notice] : sent_packets<LossNotice>(network)) {
    for (const LostPath& lost : notice.lost) {
      is_told |= frame.from == routing::test::id(2) && lost.hops == 3 &&
                 lost.next_hop == routing::test::id(4);
    }
  }
  EXPECT_TRUE(is_told);
}

TEST(AntHocNetFailure, AMessageWhereThereIsNoTrailWarnsItsSender) {
  Network network(3, ant_config());
  routing::test::connect_chain(network);
  network.send(1, 3);
  network.run(100ms);
  network.node(2).router->invalidate("help", routing::test::id(3));
  network.disconnect(2, 3);
  network.run(10ms);
  network.node(2).router->invalidate("help", routing::test::id(3));
  network.send(1, 3);
  network.run(20ms);
  EXPECT_EQ(events(network, ProtocolEvent::kWarningSent), 1);
  EXPECT_TRUE(network.node(1).router->routes("help", id(3)).empty());
}

/// A network whose links come and go at random.
class Storm {
 public:
  explicit Storm(std::uint64_t seed, LinkCapabilities can)
      : random_(seed, "storm"), network_(12, config(), seed, can) {
    for (int a = 1; a <= 12; ++a) {
      for (int b = a + 1; b <= 12; ++b) toggle(a, b);
    }
  }

  void blow() {
    for (int step = 0; step < 150; ++step) {
      const int a = pick(), b = pick();
      if (a != b) toggle(a, b);
      const int from = pick(), to = pick();
      if (from != to) network_.send(from, to);
      network_.run(Duration{static_cast<std::int64_t>(random_.uniform() * 3e8)});
    }
    network_.run(60s);
  }

  Network& network() { return network_; }

 private:
  static RoutingConfig config() {
    RoutingConfig config = ant_config();
    config.hop_limit = 20;
    return config;
  }
  int pick() { return 1 + static_cast<int>(random_.below(12)); }
  void toggle(int a, int b) {
    if (random_.uniform() < 0.2) {
      network_.connect(a, b);
    } else {
      network_.disconnect(a, b);
    }
  }

  RandomStream random_;
  Network network_;
};

class AntHocNetInAStorm : public testing::TestWithParam<bool> {};

TEST_P(AntHocNetInAStorm, EveryMessageEndsOnceAndWithinTheHopLimit) {
  const auto can = GetParam() ? Network::kEverything : Network::kNothing;
  int delivered = 0, ended = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Storm storm(seed, can);
    storm.blow();
    std::map<std::pair<AgentId, MessageId>, int> ends;
    for (const auto& end : storm.network().ends) {
      // Where an acknowledgement is lost with its link, the copy that failed here lives on there.
      if (GetParam() || end.verdict == Verdict::kDelivered) ++ends[{end.sent_by, end.id}];
      delivered += end.verdict == Verdict::kDelivered;
      ++ended;
    }
    int sent = 0;
    for (int number = 1; number <= 12; ++number) {
      TestNode& node = storm.network().node(number);
      sent += static_cast<int>(node.last_id);
      EXPECT_EQ(node.fates.size(), node.last_id) << "seed " << seed << ", node " << number;
      EXPECT_EQ(node.router->malformed_frames(), 0u);
      for (const int transmissions : node.transmissions_of) EXPECT_LE(transmissions, 20);
    }
    for (const auto& [message, count] : ends) EXPECT_EQ(count, 1) << "seed " << seed;
    if (GetParam()) {
      EXPECT_EQ(static_cast<int>(ends.size()), sent) << "seed " << seed;
    }
  }
  EXPECT_GT(delivered, 200);
  EXPECT_GT(ended, delivered) << "some must fail, or the storm is none";
}
INSTANTIATE_TEST_SUITE_P(Links, AntHocNetInAStorm, testing::Bool(), [](const auto& link) {
  return link.param ? std::string("WithStatus") : std::string("WithoutStatus");
});

}  // namespace
}  // namespace hal::node::routing::anthocnet::test
