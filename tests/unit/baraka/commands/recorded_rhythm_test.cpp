#include "baraka/commands/recorded_rhythm.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "hal/types/math.h"
#include "hal/types/random.h"

namespace baraka::commands {
namespace {

using hal::files::recording::RecordedSample;
using Samples = std::vector<RecordedSample>;
using Kind = RecordedRhythm::Kind;
using testing::ElementsAre;

RecordedSample at(double seconds, std::uint32_t bytes = 100) {
  return {hal::from_seconds(seconds), bytes};
}

TEST(RecordedRhythm, IsPeriodicWithTheJitterThatMadeIt) {
  hal::RandomStream random(1, "jitter");
  for (const double jitter : {0.0, 2e-3, 10e-3, 25e-3}) {
    Samples samples;
    for (int i = 0; i < 2000; ++i)
      samples.push_back(at(1 + 0.1 * i + jitter * (2 * random.uniform() - 1)));
    const RecordedRhythm rhythm = rhythm_of(samples);
    ASSERT_EQ(rhythm.kind, Kind::kPeriodic) << jitter;
    EXPECT_NEAR(rhythm.rate, 10, 0.01);
    EXPECT_NEAR(rhythm.jitter, jitter, 0.05 * jitter + 1e-9);
  }
}

TEST(RecordedRhythm, IsPeriodicWhereSamplesWereLost) {
  Samples samples;
  for (int i = 0; i < 1000; ++i) {
    if (i % 10 != 3) samples.push_back(at(0.1 * i));
  }
  const RecordedRhythm rhythm = rhythm_of(samples);
  EXPECT_EQ(rhythm.kind, Kind::kPeriodic);
  EXPECT_NEAR(rhythm.rate, 9, 0.01);  // as many samples in a second as there are
  EXPECT_NEAR(rhythm.jitter, 0, 1e-9);
}

TEST(RecordedRhythm, IsPoissonWhereGapsAreExponential) {
  hal::RandomStream random(1, "gaps");
  Samples samples;
  double now = 0;
  for (int i = 0; i < 4000; ++i) {
    now -= hal::math::log(1 - random.uniform()) / 20;
    samples.push_back(at(now));
  }
  const RecordedRhythm rhythm = rhythm_of(samples);
  EXPECT_EQ(rhythm.kind, Kind::kPoisson);
  EXPECT_NEAR(rhythm.rate, 20, 1);  // three standard deviations of 4000 gaps
  EXPECT_NEAR(rhythm.gap_sd / rhythm.gap_mean, 1, 0.1);
}

TEST(RecordedRhythm, IsInBurstsWhereGroupsAreApart) {
  Samples samples;
  for (int burst = 0; burst < 10; ++burst) {
    for (int i = 0; i < 5; ++i) samples.push_back(at(2 * burst + 0.001 * i));
  }
  const RecordedRhythm rhythm = rhythm_of(samples);
  EXPECT_EQ(rhythm.kind, Kind::kBursts);
  EXPECT_NEAR(rhythm.rate, 0.5, 1e-9);
  EXPECT_EQ(rhythm.samples, 5U);
  EXPECT_NEAR(rhythm.spacing, 1e-3, 1e-9);
}

TEST(RecordedRhythm, HasNoRateOfTwoSamplesOrOfRareOnes) {
  EXPECT_EQ(rhythm_of({}).kind, Kind::kFew);
  EXPECT_EQ(rhythm_of({at(0)}).kind, Kind::kFew);
  EXPECT_EQ(rhythm_of({at(0), at(1)}).kind, Kind::kFew);
  EXPECT_EQ(rhythm_of({at(1), at(1), at(1)}).kind, Kind::kFew);
  EXPECT_EQ(rhythm_of({at(0), at(1500), at(3000)}).kind, Kind::kFew);
}

TEST(RecordedSizes, AreOneSizeOrACycle) {
  EXPECT_THAT(sizes_of({at(0, 80), at(1, 80), at(2, 80)}).in_turn, ElementsAre(80));
  EXPECT_THAT(sizes_of({at(0, 80), at(1, 20), at(2, 80), at(3, 20), at(4, 80)}).in_turn,
              ElementsAre(80, 20));
}

TEST(RecordedSizes, StandForTenthsOfTheSamplesOtherwise) {
  hal::RandomStream random(1, "sizes");
  Samples samples;
  for (int i = 0; i < 10000; ++i)
    samples.push_back(at(i, 1000 + static_cast<std::uint32_t>(random.uniform() * 1000)));
  const RecordedSizes sizes = sizes_of(samples);
  ASSERT_EQ(sizes.in_turn.size(), 10U);
  std::vector<std::uint32_t> sorted = sizes.in_turn;
  std::ranges::sort(sorted);
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    EXPECT_NEAR(sorted[i], 1050 + 100.0 * static_cast<double>(i), 20);
    sum += sorted[i];
  }
  EXPECT_NE(sorted, sizes.in_turn);
  EXPECT_NEAR(static_cast<double>(sum) / 10, static_cast<double>(sizes.sum) / 10000, 1);
}

}  // namespace
}  // namespace baraka::commands
