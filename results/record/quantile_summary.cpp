#include "results/record/quantile_summary.h"

#include <algorithm>
#include <cmath>

#include "hal/types/check.h"

namespace results::record {

void QuantileSummary::add(double value) {
  fresh_.push_back(value);
  const std::size_t room = entries_.empty() ? kExact : static_cast<std::size_t>(0.5 / kError);
  if (fresh_.size() > room) merge();
}

double QuantileSummary::quantile(double p) {
  BARAKA_CHECK(count() > 0);
  if (entries_.empty()) return exact(p);
  if (!fresh_.empty()) merge();
  return estimate(p);
}

double QuantileSummary::exact(double p) {
  std::sort(fresh_.begin(), fresh_.end());
  const double place = static_cast<double>(fresh_.size() - 1) * p;
  const auto below = static_cast<std::size_t>(std::floor(place));
  const std::size_t above = std::min(below + 1, fresh_.size() - 1);
  return fresh_[below] + (place - std::floor(place)) * (fresh_[above] - fresh_[below]);
}

/// A value between two entries can have any rank that the upper entry can have.
void QuantileSummary::merge() {
  std::sort(fresh_.begin(), fresh_.end());
  std::vector<Entry> all;
  all.reserve(entries_.size() + fresh_.size());
  auto next = entries_.begin();
  for (const double value : fresh_) {
    while (next != entries_.end() && next->value <= value) all.push_back(*next++);
    const bool is_outermost = next == entries_.end() || next == entries_.begin();
    all.push_back({value, 1, is_outermost ? 0 : next->covered + next->slack - 1});
  }
  all.insert(all.end(), next, entries_.end());
  merged_ += fresh_.size();
  fresh_.clear();
  entries_ = std::move(all);
  compress();
}

/// Joins entries as long as no rank becomes more uncertain than 2 kError times the count. The first
/// and the last entry are kept: they are the minimum and the maximum.
void QuantileSummary::compress() {
  const auto most = static_cast<std::uint64_t>(2 * kError * static_cast<double>(merged_));
  std::vector<Entry> kept{entries_.back()};
  for (std::size_t i = entries_.size() - 1; i-- > 0;) {
    Entry& above = kept.back();
    const bool is_outermost = i == 0 || kept.size() == 1;
    if (!is_outermost && entries_[i].covered + above.covered + above.slack <= most) {
      above.covered += entries_[i].covered;
    } else {
      kept.push_back(entries_[i]);
    }
  }
  entries_.assign(kept.rbegin(), kept.rend());
}

double QuantileSummary::estimate(double p) const {
  const auto n = static_cast<double>(merged_);
  const double rank = std::clamp(std::ceil(p * n), 1.0, n);
  const double allowed = kError * n;
  double lowest = 0;  // lower limit of the entry's rank
  for (const Entry& entry : entries_) {
    lowest += static_cast<double>(entry.covered);
    const double highest = lowest + static_cast<double>(entry.slack);
    if (rank - lowest <= allowed && highest - rank <= allowed) return entry.value;
  }
  return entries_.back().value;
}

}  // namespace results::record
