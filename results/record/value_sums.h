#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "hal/types/time.h"

namespace results::record {

/// Statistics of a value that is observed repeatedly, in one pass (B. P. Welford, "Note on a Method
/// for Calculating Corrected Sums of Squares and Products", Technometrics, 1962).
class ValueSums {
 public:
  /// @param value  finite. @param at  if it is before the last call's time, that time is used.
  void add(hal::Time at, double value) {
    if (count_ == 0) {
      least_ = greatest_ = value;
      first_at_ = at;
    } else {
      held_ += last_ * hal::to_seconds(std::max(at - last_at_, hal::Duration{}));
    }
    ++count_;
    const double before = value - mean_;
    mean_ += before / static_cast<double>(count_);
    squares_ += before * (value - mean_);
    sum_ += value;
    least_ = std::min(least_, value);
    greatest_ = std::max(greatest_, value);
    last_ = value;
    last_at_ = std::max(last_at_, at);
  }

  std::uint64_t count() const { return count_; }
  double mean() const { return mean_; }
  /// Standard deviation of the sample, with count() - 1 in the denominator; 0 for one value.
  double deviation() const {
    return count_ < 2 ? 0 : std::sqrt(squares_ / static_cast<double>(count_ - 1));
  }
  double least() const { return least_; }
  double greatest() const { return greatest_; }
  double sum() const { return sum_; }
  double last() const { return last_; }
  /// Mean weighted by the time for which each value was the latest, until `end`; the last value if
  /// no time has passed.
  double mean_over_time(hal::Time end) const {
    const double time = hal::to_seconds(end - first_at_);
    if (time <= 0) return last_;
    return (held_ + last_ * hal::to_seconds(end - last_at_)) / time;
  }

 private:
  std::uint64_t count_ = 0;
  double mean_ = 0, squares_ = 0, sum_ = 0, least_ = 0, greatest_ = 0, last_ = 0;
  double held_ = 0;  ///< Integral of the value over time [unit s].
  hal::Time first_at_{}, last_at_{};
};

}  // namespace results::record
