#include "hal/node/routing/hello.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::test {
namespace {

const RoutingConfig kConfig{.jitter_max = Duration::zero()};  // hellos each 1 s, 2 missed

std::vector<Time> hellos_of(const Network& network, int node) {
  std::vector<Time> times;
  for (const SentFrame& frame : network.sent) {
    if (frame.from == id(node) && frame.bytes.front() == 0x16) times.push_back(frame.at);
  }
  return times;
}

TEST(Hellos, AreSentOnlyOverALinkThatCannotTell) {
  Network network(2, kConfig);
  connect_chain(network);
  network.run(10s);
  EXPECT_TRUE(network.sent.empty());
}

// RFC 5148, 5.1: the interval less up to the jitter, here a quarter.
TEST(Hellos, AreSpreadOverTheLastQuarterOfThePeriod) {
  Network network(1, kConfig, 1, Network::kNothing);
  network.run(1000s);
  const auto times = hellos_of(network, 1);
  ASSERT_GT(times.size(), 1000u);
  EXPECT_LT(times[0], Time{1s});
  Duration least = 1s, most = 0s;
  for (std::size_t i = 1; i < times.size(); ++i) {
    least = std::min(least, times[i] - times[i - 1]);
    most = std::max(most, times[i] - times[i - 1]);
  }
  EXPECT_GE(least, 750ms);
  EXPECT_LE(most, 1s);
  EXPECT_LT(least, 755ms);  // 0.98^1000: missed once in 6e8 seeds
  EXPECT_GT(most, 995ms);
}

TEST(Hellos, NeighboursDoNotKeepStep) {
  Network network(2, kConfig, 1, Network::kNothing);
  network.run(10s);
  EXPECT_NE(hellos_of(network, 1), hellos_of(network, 2));
}

TEST(Hellos, MakeNeighboursKnownBeforeAnyTraffic) {
  Network network(3, kConfig, 1, Network::kNothing);
  connect_chain(network);
  network.run(2s);
  std::set<AgentId> heard;
  for (const Neighbour& neighbour : network.node(2).heard) heard.insert(neighbour.id);
  EXPECT_EQ(heard, (std::set{id(1), id(3)}));
}

TEST(Hellos, ASilentNeighbourIsLostAfterTwoPeriodsAndAHalfWithItsRoutes) {
  Network network(3, kConfig, 1, Network::kNothing);
  connect_chain(network);
  network.send(1, 3);
  network.run(5s);
  ASSERT_EQ(network.node(1).router->routes("help", id(3)).size(), 1u);
  network.disconnect(1, 2);
  const Time last = network.node(1).heard.back().last_heard;
  network.clock.run_until(last + 2500ms - 1ns);
  EXPECT_TRUE(network.node(1).lost.empty());
  network.run(1ns);
  EXPECT_EQ(network.node(1).lost, std::vector{id(2)});
  EXPECT_TRUE(network.node(1).router->routes("help", id(3)).empty());
  network.run(60s);
  EXPECT_EQ(network.node(1).lost.size(), 1u);  // reported once
  EXPECT_TRUE(network.node(3).lost.empty());
}

TEST(Hellos, ASilentNeighbourNeedsNoMoreAttempts) {
  RoutingConfig patient = kConfig;
  patient.ack_timeout = 10s;
  Network network(2, patient, 1, Network::kNothing);
  connect_chain(network);
  network.send(1, 2);
  network.run(5s);
  network.disconnect(1, 2);
  const Time last = network.node(1).heard.back().last_heard;
  network.send(1, 2);
  const auto searches = [&] {
    return std::count_if(network.sent.begin(), network.sent.end(), [](const SentFrame& frame) {
      return frame.from == id(1) && frame.bytes.front() == 0x11;  // forward ant
    });
  };
  EXPECT_EQ(searches(), 1);
  network.clock.run_until(last + 2500ms);
  EXPECT_EQ(searches(), 2);  // salvage
}

TEST(Hellos, ANeighbourThatIsHeardAgainCanBeLostAgain) {
  Network network(2, kConfig, 1, Network::kNothing);
  for (int round = 1; round <= 3; ++round) {
    network.connect(1, 2);
    network.run(5s);
    network.disconnect(1, 2);
    network.run(5s);
    EXPECT_EQ(network.node(1).lost.size(), static_cast<std::size_t>(round));
  }
}

// One hello lost now and then is no loss of a neighbour.
TEST(Hellos, EverySecondOneIsEnough) {
  Network network(2, kConfig, 1, Network::kNothing);
  connect_chain(network);
  std::map<AgentId, int> count;
  network.is_lost = [&](AgentId from, AgentId) { return ++count[from] % 2 == 0; };
  network.run(100s);
  EXPECT_TRUE(network.node(1).lost.empty());
  EXPECT_TRUE(network.node(2).lost.empty());
}

TEST(Hellos, AnyFrameIsASignOfLife) {
  Network network(1, kConfig, 1, Network::kNothing);
  for (int second = 0; second < 20; ++second) {
    network.node(1).router->on_frame({.from = id(2)}, encode(HopAck{1}));
    network.run(1s);
  }
  EXPECT_TRUE(network.node(1).lost.empty());
}

TEST(Hellos, WhoListensGoesByThePeriodOfWhoTalks) {
  Network network(1, kConfig, 1, Network::kNothing);
  network.node(1).router->on_frame({.from = id(2)}, encode(Hello{10s}));
  network.node(1).router->on_frame({.from = id(3)}, encode(Hello{100ms}));
  network.run(250ms - 1ns);
  EXPECT_TRUE(network.node(1).lost.empty());
  network.run(1ns);
  EXPECT_EQ(network.node(1).lost, std::vector{id(3)});
  network.clock.run_until(Time{25s} - 1ns);
  EXPECT_EQ(network.node(1).lost.size(), 1u);
  network.run(1ns);
  EXPECT_EQ(network.node(1).lost.size(), 2u);
}

}  // namespace
}  // namespace hal::node::routing::test
