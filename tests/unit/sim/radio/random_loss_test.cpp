#include "sim/radio/channel/random_loss.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/sim/radio/air.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

/// Broadcasts of station 1, one every 10 ms, and what becomes of them at the others, 10 m away.
class Loss : public testing::TestWithParam<Profile> {
 protected:
  static constexpr int kFrames = 2000;

  Loss() : air(GetParam()) {}
  LossConfig& loss() { return waves_of(air.config)->receiver.loss; }
  void run(int stations, std::uint16_t from = 1) {
    air.add_line(stations, 10);
    air.build();
    for (int i = 0; i < kFrames; ++i) {
      air.at(i * 10ms, [this, from] { air.broadcast(from); });
    }
    air.run(kFrames * 10ms);
  }
  std::size_t heard(std::uint16_t station) { return air.inbox(station).received.size(); }
  /// The numbers of the broadcasts that it got.
  static std::vector<std::int64_t> got(Air& air, std::uint16_t station) {
    std::vector<std::int64_t> numbers;
    for (const auto& one : air.inbox(station).received) {
      numbers.push_back(one.at.time_since_epoch() / 10ms);
    }
    return numbers;
  }

  Air air;
};

// Binomial: mean n p, and 4 standard deviations of sqrt(n p (1 - p)) but once in 16,000 tries.
void expect_share(std::size_t lost, int of, double probability) {
  const double deviation = std::sqrt(of * probability * (1 - probability));
  EXPECT_NEAR(static_cast<double>(lost), of * probability, 4 * deviation);
}

TEST_P(Loss, TakesItsShareAndTellsItApart) {
  loss().probability = 0.3;
  run(3);
  std::size_t lost = 0, delivered = 0;
  for (const auto& reception : air.log.receptions) {
    lost += reception.verdict == hal::Verdict::kRandomLoss ? 1u : 0u;
    delivered += reception.verdict == hal::Verdict::kDelivered ? 1u : 0u;
  }
  EXPECT_EQ(lost + delivered, 2u * kFrames) << "each frame at each of two stations";
  expect_share(kFrames - heard(2), kFrames, 0.3);
  expect_share(kFrames - heard(3), kFrames, 0.3);
  // Independent: both lose it with 0.09.
  const auto two = got(air, 2), three = got(air, 3);
  std::vector<std::int64_t> both;
  std::ranges::set_intersection(two, three, std::back_inserter(both));
  expect_share(both.size(), kFrames, 0.49);
}

TEST_P(Loss, IsOfTheLinksThatItNames) {
  loss().links = {{"s1", "*", 0.2}, {"*", "s3", 1}};
  run(4);
  expect_share(kFrames - heard(2), kFrames, 0.2);
  EXPECT_EQ(heard(3), 0u) << "the last entry that fits counts";
  expect_share(kFrames - heard(4), kFrames, 0.2);
}

TEST_P(Loss, OfOneWaySaysNothingOfTheOther) {
  loss().links = {{"s1", "s2", 1}};
  run(2, 2);
  EXPECT_EQ(heard(1), static_cast<std::size_t>(kFrames));
}

TEST_P(Loss, OfALinkDoesNotDependOnWhoElseThereIs) {
  loss().probability = 0.3;
  run(3);
  Air larger(GetParam());
  waves_of(larger.config)->receiver.loss.probability = 0.3;
  larger.add({0, 5, 0}, {}, "another");  // the addresses of the others go up by one
  for (const char* name : {"s1", "s2", "s3"}) larger.add({10, 0, 0}, {}, name);
  larger.build();
  for (int i = 0; i < kFrames; ++i) larger.at(i * 10ms, [&larger] { larger.broadcast(2); });
  larger.run(kFrames * 10ms);
  EXPECT_EQ(got(larger, 3), got(air, 2));
}

INSTANTIATE_TEST_SUITE_P(WithAMedium, Loss,
                         testing::Values(Profile::kMobilityFramework, Profile::kIeee80211b,
                                         Profile::kIeee80211g));

// The receiver had the PHY header and finds the FCS wrong, so it waits for EIFS; the sender tries
// again until seven frames are lost.
TEST(LossOfAll, MakesTheSenderGiveUp) {
  Air air(Profile::kIeee80211b);
  waves_of(air.config)->receiver.loss.links = {{"s1", "s2", 1}};
  air.add_line(2, 10);
  air.build();
  air.send(1, 2, 100);
  air.run();
  EXPECT_EQ(air.log.story(), "DATA1 DATA1 DATA1 DATA1 DATA1 DATA1 DATA1");
  EXPECT_EQ(air.log.verdicts(0, 2), std::vector{hal::Verdict::kRandomLoss});
  EXPECT_EQ(air.inbox(1).ended.at(0).verdict, hal::Verdict::kRetryLimit);
}

TEST(LossThatIsNoProbability, IsRefused) {
  Air air(Profile::kIeee80211b);
  waves_of(air.config)->receiver.loss.probability = 1.5;
  air.add({0, 0, 0});
  EXPECT_THROW(air.build(), std::invalid_argument);
}

}  // namespace
}  // namespace sim::radio::test
