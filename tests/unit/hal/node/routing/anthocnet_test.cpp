#include <gtest/gtest.h>

#include "tests/unit/hal/node/routing/anthocnet_network.h"

namespace hal::node::routing::anthocnet::test {
namespace {

int frames_between(const Network& network, int from, int to) {
  int count = 0;
  for (const SentFrame& frame : network.sent) {
    const auto packet = parse(frame.bytes);
    if (!packet || !std::holds_alternative<Data>(*packet)) continue;
    count += frame.from == routing::test::id(from) && frame.to == routing::test::id(to);
  }
  return count;
}

TEST(AntHocNet, FindsAPathAndDeliversOverIt) {
  Network network(5, ant_config());
  routing::test::connect_chain(network);
  network.send(1, 5);
  network.run(1s);
  ASSERT_EQ(network.node(5).messages.size(), 1u);
  EXPECT_EQ(network.node(5).transmissions_of, std::vector{4});
  ASSERT_EQ(network.node(1).discoveries.size(), 1u);
  EXPECT_TRUE(network.node(1).discoveries[0].found);
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates[0].fate, Fate::kHandedOver);
  const auto routes = network.node(1).router->routes("help", routing::test::id(5));
  ASSERT_EQ(routes.size(), 1u);
  EXPECT_EQ(routes[0].next_hop, id(2));
  EXPECT_EQ(routes[0].path.hops, 4);
}

TEST(AntHocNet, FindsAPathOverALinkThatTellsNothing) {
  Network network(4, ant_config(), 1, Network::kNothing);
  routing::test::connect_chain(network);
  network.run(3s);
  network.send(1, 4);
  network.run(2s);
  EXPECT_EQ(network.node(4).messages.size(), 1u);
  network.disconnect(3, 4);
  network.run(5s);
  network.send(1, 4);
  network.run(30s);
  EXPECT_EQ(network.node(4).messages.size(), 1u);
  ASSERT_EQ(network.ends.size(), 2u);
  EXPECT_NE(network.ends.back().verdict, Verdict::kDelivered);
  for (int number = 1; number <= 4; ++number) {
    EXPECT_EQ(network.node(number).router->malformed_frames(), 0u);
  }
}

TEST(AntHocNet, KeepsSeveralPathsAndSpreadsMessagesOverThem) {
  Network network(4, ant_config());
  connect_diamond(network);
  network.send(1, 4);
  network.run(1s);
  EXPECT_EQ(network.node(1).router->routes("help", id(4)).size(), 2u);
  for (int i = 0; i < 400; ++i) network.send(1, 4);
  network.run(1s);
  EXPECT_EQ(network.node(4).messages.size(), 401u);
  EXPECT_GT(frames_between(network, 1, 2), 40);
  EXPECT_GT(frames_between(network, 1, 3), 40);
}

TEST(AntHocNet, FloodsWhatIsForEveryone) {
  Network network(4, ant_config());
  routing::test::connect_chain(network);
  network.flood(1);
  network.run(1s);
  for (int number = 2; number <= 4; ++number) {
    EXPECT_EQ(network.node(number).messages.size(), 1u) << number;
  }
}

TEST(AntHocNet, GivesASearchUpAfterItsRetries) {
  RoutingConfig config = ant_config();
  config.retries = 2;
  Network network(2, config);
  const MessageId message = network.send(1, 2);
  network.run(5s);
  ASSERT_EQ(network.node(1).fates.size(), 1u);
  EXPECT_EQ(network.node(1).fates[0].id, message);
  EXPECT_EQ(network.node(1).fates[0].fate, Fate::kNoRoute);
  EXPECT_EQ(events(network, ProtocolEvent::kForwardAntSent), 2);
  ASSERT_EQ(network.ends.size(), 1u);
  EXPECT_EQ(network.ends[0].verdict, Verdict::kNoRoute);
}

// The second message finds its destination near by, while the first one still waits for an ant.
TEST(AntHocNet, SendsWhatWaitsOnceATrailOfOthersIsThere) {
  RoutingConfig config = ant_config();
  config.retry_period = 4s;
  config.buffer_age = 20s;
  Network network(2, config);
  network.send(1, 2);
  network.run(100ms);
  network.connect(1, 2);
  network.run(3s);
  network.send(1, 2);
  network.run(3s);
  EXPECT_EQ(network.node(2).messages.size(), 2u);
  ASSERT_EQ(network.node(1).discoveries.size(), 1u);
  EXPECT_TRUE(network.node(1).discoveries[0].found);
}

TEST(AntHocNet, LooksForTheDestinationNearByBeforeItGivesUp) {
  RoutingConfig config = ant_config();
  config.retry_period = 4s;
  config.retries = 1;
  config.buffer_age = 20s;
  Network network(2, config);
  network.send(1, 2);
  network.run(100ms);
  network.connect(1, 2);
  network.run(6s);
  EXPECT_EQ(network.node(2).messages.size(), 1u);
  ASSERT_EQ(network.node(1).discoveries.size(), 1u);
  EXPECT_TRUE(network.node(1).discoveries[0].found);
}

TEST(AntHocNet, ForgetsWhatIsInvalidatedAndSearchesAgain) {
  Network network(3, ant_config());
  routing::test::connect_chain(network);
  network.send(1, 3);
  network.run(1s);
  network.node(1).router->invalidate("help", routing::test::id(3));
  EXPECT_TRUE(network.node(1).router->routes("help", id(3)).empty());
  network.send(1, 3);
  network.run(1s);
  EXPECT_EQ(network.node(1).discoveries.size(), 2u);
  EXPECT_EQ(network.node(3).messages.size(), 2u);
}

TEST(AntHocNet, ReachesANeighbourKnownByItsHellosWithoutASearch) {
  Network network(2, ant_config());
  routing::test::connect_chain(network);
  network.run(2s);
  network.send(1, 2);
  network.run(10ms);
  EXPECT_EQ(network.node(2).messages.size(), 1u);
  EXPECT_TRUE(network.node(1).discoveries.empty());
}

// A reactive ant is unicast where there is pheromone: beyond node 2 nobody hears it but those on
// the path.
TEST(AntHocNet, ReactiveAntsFollowPheromone) {
  Network network(6, ant_config());
  routing::test::connect_chain(network);
  network.send(2, 5);
  network.run(500ms);
  network.sent.clear();
  network.send(1, 5);
  network.run(500ms);
  EXPECT_EQ(network.node(5).messages.size(), 2u);
  const auto ants = forward_ants(network, AntKind::kReactive);
  ASSERT_EQ(ants.size(), 4u);
  EXPECT_EQ(ants[0].first.to, kEveryone);
  for (std::size_t i = 1; i < ants.size(); ++i) EXPECT_NE(ants[i].first.to, kEveryone);
}

TEST(AntHocNet, AFrameThatIsNoneIsCounted) {
  Network network(2, ant_config());
  routing::test::connect_chain(network);
  const Bytes bad = encode(Control{ControlOf::kAntHocNet, {1, 2, 3}});
  network.node(1).router->on_frame({.from = routing::test::id(2)}, bad);
  EXPECT_EQ(network.node(1).router->malformed_frames(), 1u);
}

// An ant that says it comes from elsewhere, and an answer on a path the node is not on.
TEST(AntHocNet, AnAntThatContradictsItsFrameIsMalformed) {
  Network network(3, ant_config());
  routing::test::connect_chain(network);
  const auto hear = [&network](const ControlPacket& packet) {
    network.node(2).router->on_frame(
        {.from = routing::test::id(1)},
        encode(Control{ControlOf::kAntHocNet, encode_control(packet)}));
  };
  hear(ForwardAnt{{"help", routing::test::id(7), routing::test::id(9), 1},
                  AntKind::kReactive,
                  1,
                  {},
                  {routing::test::id(7)}});
  hear(BackwardAnt{{"help", routing::test::id(9), routing::test::id(7), 1},
                   AntKind::kReactive,
                   0,
                   {},
                   {routing::test::id(7)}});
  EXPECT_EQ(network.node(2).router->malformed_frames(), 2u);
}

TEST(AntHocNet, EqualSeedsGiveEqualFrames) {
  const auto frames_of = [](std::uint64_t seed) {
    Network network(9, ant_config(), seed);
    routing::test::connect_grid(network, 3);
    for (int i = 0; i < 20; ++i) {
      network.send(1, 9);
      network.send(7, 3);
      network.run(700ms);
    }
    std::vector<Bytes> frames;
    for (const SentFrame& frame : network.sent) frames.push_back(frame.bytes);
    return frames;
  };
  EXPECT_EQ(frames_of(3), frames_of(3));
  EXPECT_NE(frames_of(3), frames_of(4));
}

}  // namespace
}  // namespace hal::node::routing::anthocnet::test
