#include "baraka/commands/recorded_rhythm.h"

#include <algorithm>
#include <cmath>

namespace baraka::commands {
namespace {

using hal::files::recording::RecordedSample;
using Samples = std::vector<RecordedSample>;
using Kind = RecordedRhythm::Kind;

constexpr double kLeastRate = 1e-3;  // Hz, what the keys accept
// Of a period: less than what the keys accept, as the numbers are rounded when they are printed.
constexpr double kMostJitter = 0.499, kMostBurst = 0.999;
constexpr double kPeriodicShare = 0.7, kShortGap = 0.1;

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

struct MeanAndSd {
  double mean = 0, sd = 0;
};
MeanAndSd mean_and_sd(const std::vector<double>& values) {
  MeanAndSd result;
  for (const double one : values) result.mean += one;
  result.mean /= static_cast<double>(values.size());
  for (const double one : values) result.sd += (one - result.mean) * (one - result.mean);
  result.sd = std::sqrt(result.sd / static_cast<double>(values.size()));
  return result;
}

/// Gaps of samples whose period is the median; empty if it is not one.
std::vector<double> periodic_gaps(const std::vector<double>& gaps) {
  const double median = median_of(gaps);
  std::vector<double> kept;
  std::ranges::copy_if(gaps, std::back_inserter(kept),
                       [median](double gap) { return gap >= 0.5 * median && gap <= 1.5 * median; });
  const bool is_periodic =
      static_cast<double>(kept.size()) >= kPeriodicShare * static_cast<double>(gaps.size());
  return is_periodic && median > 0 ? kept : std::vector<double>{};
}

bool find_bursts(const std::vector<double>& gaps, RecordedRhythm& rhythm) {
  const double limit = kShortGap * rhythm.gap_mean;
  std::vector<double> within;
  double at = 0, last_begin = 0;  // s after the first sample
  for (const double gap : gaps) {
    at += gap;
    if (gap < limit) {
      within.push_back(gap);
    } else {
      last_begin = at;
    }
  }
  const auto between = static_cast<double>(gaps.size() - within.size());
  const double samples = static_cast<double>(gaps.size() + 1) / (between + 1);
  if (rhythm.gap_sd <= rhythm.gap_mean || samples < 2 || between < 2) return false;
  const double rate = between / last_begin, spacing = median_of(within);
  if (rate < kLeastRate || spacing * (std::round(samples) - 1) > kMostBurst / rate) return false;
  rhythm.kind = Kind::kBursts;
  rhythm.rate = rate;
  rhythm.samples = static_cast<std::uint32_t>(std::lround(samples));
  rhythm.spacing = spacing;
  return true;
}

/// The period p, up to 8, of a sequence of sizes; 0: none.
std::size_t cycle_of(const Samples& samples) {
  constexpr std::size_t kLongest = 8;
  for (std::size_t period = 1; period <= kLongest && 2 * period <= samples.size(); ++period) {
    bool repeats = true;
    for (std::size_t i = period; repeats && i < samples.size(); ++i)
      repeats = samples[i].bytes == samples[i - period].bytes;
    if (repeats) return period;
  }
  return 0;
}

}  // namespace

RecordedRhythm rhythm_of(const Samples& samples) {
  RecordedRhythm rhythm;
  if (samples.size() < 2) return rhythm;
  std::vector<double> gaps;
  gaps.reserve(samples.size() - 1);
  for (std::size_t i = 1; i < samples.size(); ++i)
    gaps.push_back(hal::to_seconds(samples[i].at - samples[i - 1].at));
  const MeanAndSd all = mean_and_sd(gaps);
  rhythm.gap_mean = all.mean;
  rhythm.gap_sd = all.sd;
  if (all.mean <= 0) return rhythm;
  rhythm.mean_rate = 1 / all.mean;
  if (gaps.size() < 2 || rhythm.mean_rate < kLeastRate) return rhythm;
  if (find_bursts(gaps, rhythm)) return rhythm;
  rhythm.rate = rhythm.mean_rate;
  const std::vector<double> kept = periodic_gaps(gaps);
  rhythm.kind = kept.empty() ? Kind::kPoisson : Kind::kPeriodic;
  // Gaps differ by two deviations: their variance is 2 * jitter^2 / 3.
  if (!kept.empty())
    rhythm.jitter = std::min(mean_and_sd(kept).sd * std::sqrt(1.5), kMostJitter * all.mean);
  return rhythm;
}

RecordedSizes sizes_of(const Samples& samples) {
  std::vector<std::uint32_t> sorted;
  sorted.reserve(samples.size());
  RecordedSizes sizes;
  for (const RecordedSample& one : samples) {
    sorted.push_back(one.bytes);
    sizes.sum += one.bytes;
  }
  std::ranges::sort(sorted);
  sizes.least = sorted.front();
  sizes.median = sorted[sorted.size() / 2];
  sizes.most = sorted.back();
  if (sizes.least == sizes.most) {
    sizes.in_turn = {sizes.least};
  } else if (const std::size_t period = cycle_of(samples); period > 0) {
    for (std::size_t i = 0; i < period; ++i) sizes.in_turn.push_back(samples[i].bytes);
  } else {
    constexpr std::size_t kTenths = 10, kStride = 3;  // 0, 3, 6, 9, 2, …
    const std::size_t parts = std::min(kTenths, sorted.size());
    for (std::size_t i = 0; i < parts; ++i) {
      const std::size_t rank = parts == kTenths ? i * kStride % kTenths : i;
      const std::size_t begin = rank * sorted.size() / parts,
                        end = (rank + 1) * sorted.size() / parts;
      std::uint64_t sum = 0;
      for (std::size_t k = begin; k < end; ++k) sum += sorted[k];
      sizes.in_turn.push_back(
          static_cast<std::uint32_t>((sum + (end - begin) / 2) / (end - begin)));
    }
  }
  return sizes;
}

}  // namespace baraka::commands
