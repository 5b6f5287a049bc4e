#include "hal/node/routing/anthocnet_pheromone.h"

#include <gtest/gtest.h>

#include "hal/node/routing/anthocnet_mac_time.h"
#include "tests/unit/hal/node/routing/test_network.h"

namespace hal::node::routing::anthocnet::test {
namespace {

using routing::test::id;
using namespace std::chrono_literals;

const Target kTarget{"help", routing::test::id(9)};

struct Changes final : RoutingObserver {
  void on_route_change(const RouteChange& change) override { all.push_back(change); }
  std::vector<RouteChange> all;
};

Route over(int next_hop, std::uint16_t hops = 2) {
  return {"help",
          routing::test::id(9),
          routing::test::id(next_hop),
          {.hops = hops, .delay = 1ms, .min_snr_db = 0, .energy = 0}};
}

TEST(Pheromone, IsARunningAverage) {
  Changes changes;
  PheromoneTable table(changes);
  table.lay(over(2), 100, 0.7);
  EXPECT_DOUBLE_EQ(table.trails(kTarget).at(0).regular, 100) << "the first sample, whole";
  table.lay(over(2), 200, 0.7);
  EXPECT_DOUBLE_EQ(table.trails(kTarget).at(0).regular, 0.7 * 100 + 0.3 * 200);
  EXPECT_EQ(changes.all.size(), 1u) << "the path is the same";
}

TEST(Pheromone, ThatIsVirtualIsNoRoute) {
  Changes changes;
  PheromoneTable table(changes);
  table.set_virtual(kTarget, routing::test::id(3), 500);
  EXPECT_TRUE(table.routes("help", hal::node::routing::test::id(9)).empty());
  EXPECT_TRUE(table.routes().empty());
  EXPECT_FALSE(table.has_regular(kTarget));
  EXPECT_EQ(table.best_virtual(kTarget)->next_hop, hal::node::routing::test::id(3));
  EXPECT_FALSE(table.remove(kTarget, hal::node::routing::test::id(3)).has_value())
      << "no route is lost";
  EXPECT_TRUE(changes.all.empty());
}

TEST(Pheromone, GoesWithTheNeighbourAndSaysWhatWasBest) {
  Changes changes;
  PheromoneTable table(changes);
  table.lay(over(2), 100, 0);
  table.lay(over(3, 4), 50, 0);
  table.set_virtual({"audio", routing::test::id(8)}, routing::test::id(3), 7);
  const auto losses = table.remove_via(routing::test::id(3));
  ASSERT_EQ(losses.size(), 1u);
  EXPECT_FALSE(losses[0].was_best);
  EXPECT_EQ(losses[0].path.hops, 4);
  EXPECT_EQ(table.best_virtual({"audio", hal::node::routing::test::id(8)}), nullptr);
  EXPECT_TRUE(table.remove(kTarget, hal::node::routing::test::id(2))->was_best);
  EXPECT_EQ(changes.all.size(), 4u) << "two laid, two removed";
  EXPECT_TRUE(table.targets().empty());
}

// Binomial, 4000 draws: four standard deviations are 4 sqrt(4000 p (1 - p)) <= 127.
TEST(Pheromone, IsChosenToThePowerOfBeta) {
  const std::vector<Trail> trails{{routing::test::id(2), 100, 0, {}},
                                  {routing::test::id(3), 200, 0, {}},
                                  {routing::test::id(4), 0, 900, {}}};
  RandomStream random(1, "pick");
  const auto share_of_3 = [&](Weight weight, double beta) {
    int chosen = 0;
    for (int i = 0; i < 4000; ++i)
      chosen += pick(trails, weight, beta, {}, random) == routing::test::id(3);
    return chosen;
  };
  EXPECT_NEAR(share_of_3(regular_weight, 0), 4000 * 0.5, 127);
  EXPECT_NEAR(share_of_3(regular_weight, 1), 4000 * 2.0 / 3, 127);
  EXPECT_NEAR(share_of_3(regular_weight, 2), 4000 * 0.8, 127);
  EXPECT_NEAR(share_of_3(any_weight, 1), 4000 * 200.0 / 1200, 127) << "4 by its virtual pheromone";
  EXPECT_EQ(share_of_3(regular_weight, 100), 4000);
}

TEST(Pheromone, OfAvoidedOrEmptyTrailsIsNotChosen) {
  RandomStream random(1, "pick");
  const std::vector<Trail> trails{{routing::test::id(2), 100, 0, {}},
                                  {routing::test::id(4), 0, 900, {}}};
  EXPECT_EQ(pick(trails, regular_weight, 2, {}, random), hal::node::routing::test::id(2));
  EXPECT_EQ(pick(trails, regular_weight, 2, {hal::node::routing::test::id(2)}, random),
            std::nullopt);
  EXPECT_EQ(pick(trails, any_weight, 2, {hal::node::routing::test::id(2)}, random), id(4));
  EXPECT_EQ(pick({}, any_weight, 2, {}, random), std::nullopt);
}

/// Takes frames and does nothing.
struct IdleLink final : Link {
  LinkCapabilities capabilities() const override { return {.tx_status = status, .rssi = false}; }
  void transmit(AgentId, Bytes, const LinkOptions&) override {}
  Duration expected_delay() const override { return 9ms; }
  double transmit_energy(std::size_t) const override { return 0; }
  bool status = true;
};

TEST(MacTime, AveragesTheServiceOfAcknowledgedFrames) {
  routing::test::Clock clock;
  IdleLink link;
  MacTime mac(link, clock, 0.7, 3ms);
  EXPECT_EQ(mac.expected_delay(), 3ms) << "nothing measured: one idle hop";
  mac.transmit(routing::test::id(2), {1}, 1);
  mac.transmit(routing::test::id(2), {1}, 2);
  EXPECT_EQ(mac.expected_delay(), 9ms) << "two frames before it";
  clock.run_until(clock.now() + 10ms);
  EXPECT_EQ(mac.on_transmitted({1, Verdict::kDelivered}), hal::node::routing::test::id(2));
  EXPECT_NEAR(mac.mac_time(), 0.7 * 0.003 + 0.3 * 0.010, 1e-12);
  clock.run_until(clock.now() + 5ms);
  mac.on_transmitted({2, Verdict::kDelivered});
  EXPECT_NEAR(mac.mac_time(), 0.7 * 0.0051 + 0.3 * 0.005, 1e-12) << "from the head of the queue";
}

TEST(MacTime, LeavesOutFailuresAndBroadcasts) {
  routing::test::Clock clock;
  IdleLink link;
  MacTime mac(link, clock, 0, 3ms);
  mac.transmit(routing::test::id(2), {1}, 1);
  mac.transmit(kEveryone, {1}, 2);
  clock.run_until(clock.now() + 10ms);
  mac.on_transmitted({1, Verdict::kRetryLimit});
  mac.on_transmitted({2, Verdict::kDelivered});
  EXPECT_EQ(mac.on_transmitted({2, Verdict::kDelivered}), std::nullopt) << "only once";
  EXPECT_EQ(mac.expected_delay(), 3ms);
}

TEST(MacTime, LeavesOutWhatTheLinkDidNotTry) {
  for (const Verdict refused : {Verdict::kQueueFull, Verdict::kRadioOff}) {
    routing::test::Clock clock;
    IdleLink link;
    MacTime mac(link, clock, 0, 3ms);
    mac.transmit(routing::test::id(2), {1}, 1);
    clock.run_until(clock.now() + 8ms);
    mac.transmit(routing::test::id(2), {1}, 2);
    EXPECT_EQ(mac.on_transmitted({2, refused}), hal::node::routing::test::id(2));
    clock.run_until(clock.now() + 2ms);
    mac.on_transmitted({1, Verdict::kDelivered});
    EXPECT_NEAR(mac.mac_time(), 0.010, 1e-12) << "not from the other frame's refusal";
  }
}

TEST(MacTime, IsTheLinksOwnExpectationWithoutTransmitStatus) {
  routing::test::Clock clock;
  IdleLink link;
  link.status = false;
  MacTime mac(link, clock, 0.7, 3ms);
  for (LinkTag tag = 1; tag < 50; ++tag) mac.transmit(routing::test::id(2), {1}, tag);
  EXPECT_EQ(mac.expected_delay(), 9ms);
}

}  // namespace
}  // namespace hal::node::routing::anthocnet::test
