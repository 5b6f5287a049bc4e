#include "results/fleet/sample_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace results::fleet {
namespace {

/// A stretch of time in which an age grows from one value to another, at 1 s/s.
struct Growth {
  double from = 0, to = 0;  ///< s
};

/// Appends how the age of a pair grew within the window.
void add_growth(const SamplePair& pair, const Window& window, std::vector<Growth>& growth) {
  std::vector<const SampleFate*> arrivals;
  for (const SampleFate& one : pair.samples) {
    if (one.left) arrivals.push_back(&one);
  }
  std::ranges::stable_sort(arrivals, {}, [](const SampleFate* one) { return *one->left; });
  hal::Time newest{};  // the start of the run, until something has come
  hal::Time since = window.from;
  const auto grow = [&](hal::Time to) {
    if (to <= since) return;
    growth.push_back({hal::to_seconds(since - newest), hal::to_seconds(to - newest)});
    since = to;
  };
  for (const SampleFate* one : arrivals) {
    grow(std::min(*one->left, window.until));
    newest = std::max(newest, one->entered);
  }
  grow(window.until);
}

/// The age that is not exceeded in this share of the time, by bisection to a microsecond.
double age_quantile(const std::vector<Growth>& growth, double share) {
  constexpr double kResolution = 1e-6;  // s
  double total = 0;
  double high = 0;
  for (const Growth& one : growth) {
    total += one.to - one.from;
    high = std::max(high, one.to);
  }
  double low = 0;
  while (high - low > kResolution) {
    const double middle = 0.5 * (low + high);
    double below = 0;
    for (const Growth& one : growth) {
      below += std::clamp(middle - one.from, 0.0, one.to - one.from);
    }
    (below >= share * total ? high : low) = middle;
  }
  return high;
}

void count(const SampleFate& sample, const Window& window, SampleMeasure& sums) {
  if (sample.entered < window.from || sample.entered >= window.until) return;
  const bool is_under_way = !sample.left && sample.verdict.empty();
  if (is_under_way && sample.entered + kGrace >= window.until) {
    ++sums.under_way;
    return;
  }
  ++sums.samples;
  if (is_under_way) {
    ++sums.lost[kUnderWay];
  } else if (!sample.left) {
    ++sums.lost[sample.lost_at.empty() ? sample.verdict
                                       : fmt::format("{} at {}", sample.verdict, sample.lost_at)];
  } else {
    ++sums.delivered;
    ++(sample.is_repaired ? sums.repaired : sums.first_try);
    sums.latencies.push_back(hal::to_seconds(*sample.left - sample.entered));
  }
}

/// Adds the part of `samples`, which are spread evenly from `begin` to `end`, in the window.
void count_lost(const char* why, double samples, const Window& of, const Window& window,
                SampleMeasure& sums) {
  const hal::Time from = std::max(of.from, window.from);
  const hal::Time until = std::min(of.until, window.until);
  if (from >= until || of.from >= of.until) return;
  const double share = hal::to_seconds(until - from) / of.seconds();
  const auto missed = static_cast<std::uint64_t>(std::round(samples * share));
  if (missed == 0) return;
  sums.samples += missed;
  sums.lost[why] += missed;
}

/// Counts what is not in the record, of a player.
void count_unrecorded(const SamplePair& pair, const Window& window, SampleMeasure& sums) {
  if (!pair.plan) return;
  const WriterPlan& plan = *pair.plan;
  const std::uint64_t recorded = pair.samples.size();
  if (plan.written > recorded) {
    const hal::Time known = pair.samples.empty() ? window.until : pair.samples.front().entered;
    count_lost(kUndiscovered, static_cast<double>(plan.written - recorded), {plan.begin, known},
               window, sums);
  }
  // One that is due at the end may be missing.
  if (plan.due && *plan.due > plan.written + 1) {
    count_lost(kUnwritten, static_cast<double>(*plan.due - plan.written),
               {plan.begin, window.until}, window, sums);
  }
}

/// When its first sample arrived; nullopt: never.
std::optional<hal::Time> first_arrival(const SamplePair& pair) {
  std::optional<hal::Time> first;
  for (const SampleFate& one : pair.samples) {
    if (one.left && (!first || *one.left < *first)) first = one.left;
  }
  return first;
}

}  // namespace

std::optional<double> SampleMeasure::delivered_share() const {
  if (samples == 0) return std::nullopt;
  return static_cast<double>(delivered) / static_cast<double>(samples);
}

SampleMeasure measure(const std::vector<const SamplePair*>& pairs, const Window& window) {
  SampleMeasure sums;
  std::vector<Growth> growth;
  std::optional<hal::Time> last;
  for (const SamplePair* pair : pairs) {
    ++sums.pairs;
    const auto first = first_arrival(*pair);
    if (!first) ++sums.silent;
    if (first && (!last || *first > *last)) last = first;
    count_unrecorded(*pair, window, sums);
    for (const SampleFate& sample : pair->samples) count(sample, window, sums);
    add_growth(*pair, window, growth);
  }
  std::ranges::sort(sums.latencies);
  if (!growth.empty()) sums.age95 = age_quantile(growth, 0.95);
  if (sums.silent == 0 && last) sums.discovered = hal::to_seconds(*last);
  return sums;
}

}  // namespace results::fleet
