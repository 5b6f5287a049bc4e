#include "results/record/value_histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace results::record {

ValueHistogram::ValueHistogram(std::size_t bins, std::optional<std::pair<double, double>> range)
    : is_automatic_(!range),
      has_range_(range.has_value()),
      counts_(range ? bins : bins + bins % 2, 0) {
  if (!range) return;
  low_ = range->first;
  width_ = (range->second - range->first) / static_cast<double>(bins);
}

void ValueHistogram::add(double value) {
  if (has_range_) return count(value);
  kept_.push_back(value);
  if (kept_.size() == kKept) choose_range();
}

void ValueHistogram::choose_range() {
  const auto [least, greatest] = std::minmax_element(kept_.begin(), kept_.end());
  const auto bins = static_cast<double>(counts_.size());
  low_ = *least;
  // Slightly wider, so that the greatest value is below the upper bound.
  width_ = (*greatest - *least) / bins * (1 + 1e-9);
  const double finest = std::max(std::abs(*least), std::abs(*greatest)) * 1e-9;
  if (width_ <= finest) {  // all values are equal, or nearly so
    width_ = finest > 0 ? 2 * finest : 1 / bins;
  }
  has_range_ = true;
  for (const double value : kept_) count(value);
  std::vector<double>().swap(kept_);
}

void ValueHistogram::count(double value) {
  const auto bins = static_cast<double>(counts_.size());
  if (is_automatic_) {
    while (value < low_) widen_down();
    while (value >= low_ + bins * width_) widen_up();
  }
  const double place = std::floor((value - low_) / width_);
  if (value < low_) {
    ++below_;
  } else if (place >= bins) {
    ++above_;
  } else {
    ++counts_[static_cast<std::size_t>(place)];
  }
}

void ValueHistogram::widen_up() {
  const std::size_t half = counts_.size() / 2;
  for (std::size_t i = 0; i < half; ++i) counts_[i] = counts_[2 * i] + counts_[2 * i + 1];
  std::fill(counts_.begin() + static_cast<std::ptrdiff_t>(half), counts_.end(), 0);
  width_ *= 2;
}

void ValueHistogram::widen_down() {
  const std::size_t half = counts_.size() / 2;
  for (std::size_t i = half; i-- > 0;) {
    counts_[half + i] = counts_[2 * i] + counts_[2 * i + 1];
  }
  std::fill(counts_.begin(), counts_.begin() + static_cast<std::ptrdiff_t>(half), 0);
  low_ -= static_cast<double>(counts_.size()) * width_;
  width_ *= 2;
}

std::vector<Bins::Bin> ValueHistogram::bins() {
  if (!has_range_ && !kept_.empty()) choose_range();
  if (!has_range_) return {};
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const auto edge = [this](std::size_t i) { return low_ + static_cast<double>(i) * width_; };
  std::vector<Bins::Bin> all;
  if (below_ > 0) all.push_back({-kInfinite, low_, below_});
  for (std::size_t i = 0; i < counts_.size(); ++i)
    all.push_back({edge(i), edge(i + 1), counts_[i]});
  if (above_ > 0) all.push_back({edge(counts_.size()), kInfinite, above_});
  return all;
}

}  // namespace results::record
