#include "hal/node/routing/ants.h"

#include <gtest/gtest.h>

#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::test {
namespace {

/// One node that is fed ants made by hand; nobody hears what it sends.
class AntsTest : public testing::Test {
 protected:
  static constexpr int kSelf = 1;
  static constexpr std::uint16_t kOrigin = 100;

  AntsTest() : network(2, {.jitter_max = Duration::zero()}) {}

  /// A forward ant from kOrigin that has made `hops` hops, over relays that begin with `relay`.
  static ForwardAnt ant(int destination, int hops, std::uint16_t relay = 200) {
    ForwardAnt made{.header = {"help", AgentId{kOrigin}, id(destination), 1},
                    .started = {},
                    .path = {AgentId{kOrigin}},
                    .way = {}};
    for (int hop = 1; hop < hops; ++hop) made.path.push_back(AgentId{relay++});
    made.way.hops = static_cast<std::uint16_t>(hops - 1);
    return made;
  }

  void feed(const ForwardAnt& forward) { feed(forward.path.back(), forward); }
  void feed(AgentId from, const Packet& packet) {
    network.node(kSelf).router->on_frame({.from = from, .snr_db = 20}, encode(packet));
  }
  std::size_t sent() const { return network.sent.size(); }

  Network network;
};

TEST_F(AntsTest, ALaterCopyIsJudgedByHops) {
  network.run(10ms);  // every copy takes as long as the first: time is inside the band
  feed(ant(kSelf, 4, 200));
  feed(ant(kSelf, 6, 300));
  EXPECT_EQ(sent(), 2u);
  feed(ant(kSelf, 7, 400));
  EXPECT_EQ(sent(), 2u);
}

TEST_F(AntsTest, ALaterCopyIsJudgedByTime) {
  network.run(10ms);
  feed(ant(kSelf, 4, 200));
  network.run(5ms);
  feed(ant(kSelf, 4, 300));  // 15 ms: at the edge
  EXPECT_EQ(sent(), 2u);
  network.run(1ns);
  feed(ant(kSelf, 4, 400));
  EXPECT_EQ(sent(), 2u);
}

TEST_F(AntsTest, ABetterCopyNarrowsTheBand) {
  network.run(10ms);
  feed(ant(kSelf, 6, 200));
  feed(ant(kSelf, 4, 300));
  EXPECT_EQ(sent(), 2u);
  feed(ant(kSelf, 7, 400));  // within 1.5 x 6, beyond 1.5 x 4
  EXPECT_EQ(sent(), 2u);
}

TEST_F(AntsTest, ClocksThatDisagreeLeaveTheJudgementToTheHops) {
  ForwardAnt early = ant(kSelf, 4, 200);
  early.started = Time{1h};
  feed(early);
  network.run(10ms);
  ForwardAnt late = ant(kSelf, 5, 300);
  late.started = Time{1h};
  feed(late);
  EXPECT_EQ(sent(), 2u);
}

TEST_F(AntsTest, AnAntThatWasHereIsNotTakenAgain) {
  ForwardAnt forward = ant(9, 3);
  forward.path[1] = id(kSelf);
  feed(forward);
  EXPECT_EQ(sent(), 0u);
}

TEST_F(AntsTest, AForwardAntMustComeFromTheEndOfItsPath) {
  feed(AgentId{999}, ant(kSelf, 3));
  EXPECT_EQ(sent(), 0u);
  EXPECT_EQ(network.node(kSelf).router->malformed_frames(), 1u);
}

class BackwardAntsTest : public AntsTest {
 protected:
  /// The answer of node 9 to an ant with path kOrigin, 200, self: 9 itself transmits.
  static BackwardAnt answer() {
    return {.header = {"help", id(9), AgentId{kOrigin}, 1},
            .path = {AgentId{kOrigin}, AgentId{200}, id(kSelf)},
            .position = 2,
            .way = {}};
  }
};

TEST_F(BackwardAntsTest, WalkBackTheWayTheForwardAntCame) {
  feed(ant(9, 2));
  feed(id(9), answer());
  ASSERT_EQ(sent(), 2u);
  EXPECT_EQ(network.sent[1].to, AgentId{200});
  BackwardAnt expected = answer();
  expected.position = 1;
  expected.way = {.hops = 1, .delay = 1ms, .min_snr_db = 20, .energy = 0.5};
  EXPECT_EQ(parse(network.sent[1].bytes), Packet{expected});
}

TEST_F(BackwardAntsTest, TeachTheWayBackWithWhatTheForwardAntGathered) {
  feed(ant(9, 2));
  feed(id(9), answer());
  const auto back = network.node(kSelf).router->routes("help", AgentId{kOrigin});
  ASSERT_EQ(back.size(), 1u);
  EXPECT_EQ(back[0].next_hop, AgentId{200});
  EXPECT_EQ(back[0].path.hops, 2);
  EXPECT_DOUBLE_EQ(back[0].path.energy, 0.5);  // J: the fed ant claims 0 for its first hop
}

TEST_F(BackwardAntsTest, TeachOnlyTheWayForwardIfTheForwardAntWasNeverSeen) {
  feed(id(9), answer());
  EXPECT_TRUE(network.node(kSelf).router->routes("help", AgentId{kOrigin}).empty());
  EXPECT_EQ(network.node(kSelf).router->routes("help", id(9)).size(), 1u);
  EXPECT_EQ(sent(), 1u);
}

TEST_F(BackwardAntsTest, ForAnotherNodeOrFromAWrongOneAreRefused) {
  feed(AgentId{300}, answer());
  BackwardAnt for_another = answer();
  for_another.path[2] = AgentId{300};
  feed(id(9), for_another);
  EXPECT_EQ(network.node(kSelf).router->malformed_frames(), 2u);
  EXPECT_EQ(sent(), 0u);
  EXPECT_TRUE(network.node(kSelf).changes.empty());
}

// A search of another node brings the route that a message here waits for.
TEST_F(BackwardAntsTest, ReleaseMessagesThatWaitForEitherEnd) {
  network.send(kSelf, kOrigin);
  network.send(kSelf, 9);
  feed(ant(9, 2));
  ASSERT_EQ(sent(), 3u);  // our two searches and the relayed ant
  feed(id(9), answer());
  ASSERT_EQ(sent(), 6u);  // the answer on its way, then both messages
  EXPECT_EQ(network.sent[4].to, id(9));
  EXPECT_EQ(network.sent[5].to, AgentId{200});
}

TEST_F(AntsTest, AnsweringReleasesMessagesForTheOneWhoAsked) {
  network.send(kSelf, kOrigin);
  feed(ant(kSelf, 2));
  ASSERT_EQ(sent(), 3u);  // our search, the answer, the message
  EXPECT_EQ(network.sent[2].to, AgentId{200});
}

}  // namespace
}  // namespace hal::node::routing::test
