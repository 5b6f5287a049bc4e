#include "hal/node/routing/next_hop.h"

#include <gtest/gtest.h>

#include <map>

namespace hal::node::routing {
namespace {

constexpr AgentId kDestination{99};

Route via(std::uint16_t next_hop, std::uint16_t hops) {
  return {"help", kDestination, AgentId{next_hop}, {.hops = hops}};
}

std::map<int, int> draw(const std::vector<Route>& routes, const RouteChoice& choice, int draws) {
  RandomStream random(42, "next hop");
  std::map<int, int> counts;
  for (int i = 0; i < draws; ++i) {
    ++counts[pick_next_hop(routes, std::nullopt, choice, random).value().value];
  }
  return counts;
}

double chi_square(const std::map<int, int>& counts, const std::map<int, double>& probability,
                  int draws) {
  double sum = 0;
  for (const auto& [next_hop, p] : probability) {
    const auto found = counts.find(next_hop);
    const double seen = found == counts.end() ? 0 : found->second;
    sum += (seen - draws * p) * (seen - draws * p) / (draws * p);
  }
  return sum;
}

// Hops 1, 2, 4 with beta 2: weights 1, 1/4, 1/16, so 16/21, 4/21, 1/21.
TEST(NextHop, IsDrawnInProportionToInverseHopsSquared) {
  const auto counts = draw({via(1, 1), via(2, 2), via(3, 4)}, {}, 42000);
  const std::map<int, double> expected = {{1, 16.0 / 21}, {2, 4.0 / 21}, {3, 1.0 / 21}};
  EXPECT_LT(chi_square(counts, expected, 42000), 13.82);  // 2 degrees of freedom, 0.1 % level
}

// Beta 1: weights 1, 1/2, 1/4, so 4/7, 2/7, 1/7.
TEST(NextHop, FollowsTheExponent) {
  const auto counts = draw({via(1, 1), via(2, 2), via(3, 4)}, {.beta = 1}, 42000);
  const std::map<int, double> expected = {{1, 4.0 / 7}, {2, 2.0 / 7}, {3, 1.0 / 7}};
  EXPECT_LT(chi_square(counts, expected, 42000), 13.82);  // as above
}

// (1e6)^2 against (1/2)^2: the other route has probability 2.5e-13.
TEST(NextHop, TheDestinationItselfIsAllButCertain) {
  const auto counts = draw({via(2, 2), via(kDestination.value, 1)}, {}, 10000);
  EXPECT_EQ(counts.at(kDestination.value), 10000);
}

// Direct weight 2, beta 1: 2 against 1/2.
TEST(NextHop, WeighsTheDestinationByDirectWeight) {
  const RouteChoice choice{.metric = {.direct_weight = 2}, .beta = 1};
  const auto counts = draw({via(2, 2), via(kDestination.value, 1)}, choice, 42000);
  const std::map<int, double> expected = {{kDestination.value, 0.8}, {2, 0.2}};
  EXPECT_LT(chi_square(counts, expected, 42000), 10.83);  // 1 degree of freedom, 0.1 % level
}

TEST(NextHop, AHugeExponentPicksTheShortestInsteadOfOverflowing) {
  const auto counts = draw({via(1, 3), via(2, 2)}, {.beta = 5000}, 1000);
  EXPECT_EQ(counts.at(2), 1000);
}

TEST(NextHop, DoesNotGoBackIfThereIsAnotherWay) {
  RandomStream random(1, "next hop");
  for (int i = 0; i < 200; ++i) {
    EXPECT_EQ(pick_next_hop({via(1, 1), via(2, 9)}, AgentId{1}, {}, random), AgentId{2});
  }
}

TEST(NextHop, GoesBackIfThereIsNoOtherWay) {
  RandomStream random(1, "next hop");
  EXPECT_EQ(pick_next_hop({via(1, 1)}, AgentId{1}, {}, random), AgentId{1});
}

TEST(NextHop, IsNoneWithoutRoutes) {
  RandomStream random(1, "next hop");
  EXPECT_FALSE(pick_next_hop({}, std::nullopt, {}, random));
}

TEST(NextHop, DrawsNoRandomNumberForASingleChoice) {
  RandomStream used(1, "next hop");
  RandomStream untouched(1, "next hop");
  (void)pick_next_hop({via(1, 1)}, std::nullopt, {}, used);
  (void)pick_next_hop({via(1, 1), via(2, 1)}, AgentId{2}, {}, used);
  EXPECT_EQ(used.next(), untouched.next());
}

}  // namespace
}  // namespace hal::node::routing
