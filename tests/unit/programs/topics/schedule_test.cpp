#include "programs/topics/schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace programs::topics {
namespace {

using namespace std::chrono_literals;

Plan plan_of(std::uint64_t seed, const std::string& name = "r0") {
  return {.name = name,
          .domain = 0,
          .seed = seed,
          .begin = 1s,
          .journal = {},
          .writes = {},
          .reads = {}};
}

WrittenTopic topic_with(decltype(WrittenTopic::rhythm) rhythm,
                        decltype(WrittenTopic::sizes) sizes = SizeCycle{{100}}) {
  return {"rt/scan", {}, std::move(sizes), std::move(rhythm)};
}

std::vector<DueSample> drawn(const Plan& plan, const WrittenTopic& topic, std::size_t count) {
  Schedule schedule(plan, topic);
  std::vector<DueSample> due;
  while (due.size() < count) {
    const auto next = schedule.next();
    if (!next) break;
    due.push_back(*next);
  }
  return due;
}

std::vector<double> gaps_of(const std::vector<DueSample>& due) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < due.size(); ++i)
    gaps.push_back(hal::to_seconds(due[i].at - due[i - 1].at));
  return gaps;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double one : values) sum += one;
  return sum / static_cast<double>(values.size());
}

double variance(const std::vector<double>& values) {
  const double centre = mean(values);
  double sum = 0;
  for (const double one : values) sum += (one - centre) * (one - centre);
  return sum / static_cast<double>(values.size() - 1);
}

bool are_equal(const std::vector<DueSample>& a, const std::vector<DueSample>& b) {
  return std::ranges::equal(a, b, [](const DueSample& one, const DueSample& other) {
    return one.at == other.at && one.bytes == other.bytes;
  });
}

TEST(Schedule, IsTheSameForEqualSeedAgentAndTopicAndNoOther) {
  const std::vector<decltype(WrittenTopic::rhythm)> rhythms{Periodic{10, 5ms}, Poisson{10},
                                                            Bursts{1, 3, 1ms}};
  for (const auto& rhythm : rhythms) {
    const WrittenTopic topic = topic_with(rhythm, UniformSizes{8, 1000});
    WrittenTopic other = topic;
    other.name = "rt/odom";
    const auto first = drawn(plan_of(1), topic, 50);
    EXPECT_TRUE(are_equal(first, drawn(plan_of(1), topic, 50)));
    EXPECT_FALSE(are_equal(first, drawn(plan_of(2), topic, 50)));
    EXPECT_FALSE(are_equal(first, drawn(plan_of(1, "r1"), topic, 50)));
    EXPECT_FALSE(are_equal(first, drawn(plan_of(1), other, 50)));
  }
}

TEST(Schedule, WithoutJitterHasThePeriodAndAPhaseWithinIt) {
  const double rate = 30;  // whose period is no whole number of nanoseconds
  const auto due = drawn(plan_of(1), topic_with(Periodic{rate, 0ns}), 9001);
  EXPECT_GE(due.front().at, 0ns);
  EXPECT_LT(hal::to_seconds(due.front().at), 1 / rate);
  // Rounding is not summed up: 5 minutes, to a nanosecond.
  EXPECT_NEAR(static_cast<double>((due.back().at - due.front().at).count()), 300e9, 1);
}

TEST(Schedule, WithJitterDeviatesUniformly) {
  const double rate = 10, jitter = 0.005;
  const std::size_t count = 20000;
  const double phase = hal::to_seconds(drawn(plan_of(3), topic_with(Periodic{rate, 0ns}), 1)[0].at);
  const auto due = drawn(plan_of(3), topic_with(Periodic{rate, 5ms}), count);
  std::vector<double> deviations;
  for (std::size_t i = 0; i < count; ++i) {
    deviations.push_back(hal::to_seconds(due[i].at) - phase - static_cast<double>(i) / rate);
    ASSERT_LE(std::abs(deviations.back()), jitter + 1e-8);
  }
  // Uniform over +-j: variance j^2 / 3, fourth central moment j^4 / 5. Five standard errors.
  const double sigma = jitter / std::sqrt(3), n = static_cast<double>(count);
  EXPECT_NEAR(mean(deviations), 0, 5 * sigma / std::sqrt(n));
  const double fourth = std::pow(jitter, 4) / 5;
  EXPECT_NEAR(variance(deviations), sigma * sigma,
              5 * std::sqrt((fourth - std::pow(sigma, 4)) / n));
}

TEST(Schedule, OfPoissonHasExponentialGaps) {
  const double rate = 40;
  const std::size_t count = 40001;
  const auto gaps = gaps_of(drawn(plan_of(5), topic_with(Poisson{rate}), count));
  // Exponential: mean 1/r, variance 1/r^2, fourth central moment 9/r^4. Five standard errors.
  const double n = static_cast<double>(gaps.size());
  EXPECT_NEAR(mean(gaps), 1 / rate, 5 / rate / std::sqrt(n));
  EXPECT_NEAR(variance(gaps), 1 / (rate * rate), 5 * std::sqrt(8 / n) / (rate * rate));
  // P(gap > 2/r) = e^-2.
  const double share = std::exp(-2);
  const auto longer = std::ranges::count_if(gaps, [&](double gap) { return gap > 2 / rate; });
  EXPECT_NEAR(static_cast<double>(longer) / n, share, 5 * std::sqrt(share * (1 - share) / n));
}

TEST(Schedule, OfBurstsHasTheirSpacingAndRate) {
  const auto due = drawn(plan_of(1), topic_with(Bursts{2, 3, 7ms}), 9);
  for (std::size_t i = 0; i < 9; ++i) {
    const auto burst = static_cast<std::int64_t>(i / 3), within = static_cast<std::int64_t>(i % 3);
    EXPECT_EQ(due[i].at - due[0].at, burst * 500ms + within * 7ms) << i;
  }
}

TEST(Schedule, UsesSizesInTurn) {
  const auto due = drawn(plan_of(1), topic_with(Periodic{1, 0ns}, SizeCycle{{10, 20, 30}}), 5);
  std::vector<std::uint32_t> sizes;
  for (const DueSample& one : due) sizes.push_back(one.bytes);
  EXPECT_EQ(sizes, (std::vector<std::uint32_t>{10, 20, 30, 10, 20}));
}

TEST(Schedule, DrawsSizesUniformlyBothEndsIncluded) {
  const std::size_t count = 30000;
  const auto due = drawn(plan_of(1), topic_with(Periodic{1, 0ns}, UniformSizes{10, 14}), count);
  std::vector<std::size_t> counts(15);
  for (const DueSample& one : due) {
    ASSERT_GE(one.bytes, 10u);
    ASSERT_LE(one.bytes, 14u);
    ++counts[one.bytes];
  }
  const double n = static_cast<double>(count);
  for (std::size_t size = 10; size <= 14; ++size)
    EXPECT_NEAR(static_cast<double>(counts[size]) / n, 0.2, 5 * std::sqrt(0.2 * 0.8 / n));
}

TEST(Schedule, OfARecordingKeepsItsInstantsAndTheTopicsTimeToEachOther) {
  const Plan plan = plan_of(1);
  WrittenTopic scan = topic_with(Recorded{{{8ms, 400}, {108ms, 401}}, 0ns});
  WrittenTopic odom = topic_with(Recorded{{{20ms, 80}, {120ms, 3}}, 0ns});
  odom.name = "rt/odom";
  const auto scans = drawn(plan, scan, 10), odoms = drawn(plan, odom, 10);
  ASSERT_EQ(scans.size(), 2u);
  ASSERT_EQ(odoms.size(), 2u);
  EXPECT_EQ(scans[1].at - scans[0].at, 100ms);
  EXPECT_EQ(odoms[0].at - scans[0].at, 12ms);
  EXPECT_EQ(scans[1].bytes, 401u);
  EXPECT_EQ(odoms[1].bytes, kLeastSize);  // no sample is smaller
  EXPECT_GE(scans[0].at, 8ms);
  EXPECT_LT(scans[0].at, 1008ms);
  EXPECT_NE(drawn(plan_of(1, "r1"), scan, 1)[0].at, scans[0].at);
}

TEST(Schedule, OfARecordingThatRepeatsGoesOn) {
  const auto due = drawn(plan_of(1), topic_with(Recorded{{{0ms, 8}, {400ms, 12}}, 920ms}), 5);
  ASSERT_EQ(due.size(), 5u);
  EXPECT_EQ(due[2].at - due[0].at, 920ms);
  EXPECT_EQ(due[4].at - due[0].at, 1840ms);
  EXPECT_EQ(due[3].bytes, 12u);
}

TEST(Schedule, OfARecordingIsShiftedForEachParticipant) {
  const auto first = [](std::uint32_t participant, hal::Duration spread, std::uint64_t seed = 3) {
    WrittenTopic topic = topic_with(Recorded{{{2s, 100}, {3s, 100}}, {}, spread});
    topic.participant = participant;
    const auto due = drawn(plan_of(seed), topic, 2);
    EXPECT_EQ(due[1].at - due[0].at, 1s);  // of one participant: as recorded
    return due[0].at;
  };
  const hal::Duration alone = first(0, 10ms);
  EXPECT_EQ(alone, 2s + recording_shift(plan_of(3)));
  EXPECT_EQ(first(1, 0ms), alone);
  EXPECT_EQ(first(1, 10ms), first(1, 10ms));
  EXPECT_NE(first(1, 10ms), first(2, 10ms));
  EXPECT_NE(first(1, 10ms) - alone, first(1, 10ms, 4) - first(0, 10ms, 4));
  hal::Duration least = 1s, most = 0s;
  for (std::uint32_t one = 1; one <= 100; ++one) {
    least = std::min(least, first(one, 10ms) - alone);
    most = std::max(most, first(one, 10ms) - alone);
  }
  // Of 100 uniform draws none is in a tenth of the range with a probability of 0.9^100 = 3e-5.
  EXPECT_TRUE(least >= 0ms && least < 1ms && most > 9ms && most < 10ms);
}

TEST(Schedule, BeginsWithItsParticipantIfItHasRecordingsOnly) {
  Plan plan = plan_of(3);
  EXPECT_EQ(participant_shift(plan), 0ns);
  plan.writes = {topic_with(Recorded{{{2s, 100}}, {}, 10ms})};
  EXPECT_EQ(participant_shift(plan), 0ns);  // that of the whole agent
  plan.writes[0].participant = 1;
  const hal::Duration shift = participant_shift(plan);
  EXPECT_GT(shift, recording_shift(plan));
  EXPECT_EQ(drawn(plan, plan.writes[0], 1).at(0).at, 2s + shift);
  plan.writes.push_back(topic_with(Periodic{10, {}}));
  EXPECT_EQ(participant_shift(plan), 0ns);
}

}  // namespace
}  // namespace programs::topics
