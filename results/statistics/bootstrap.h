#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/statistics/interval.h"

namespace results::statistics {

/// A function of a sample: mean, median, …
using Statistic = std::function<double(std::span<const double>)>;

/// The indices of the values in each resample: `count` indices per resample, drawn with replacement
/// from the named stream (hal::RandomStream). The same name and seed give the same indices on every
/// machine; csv() hands them to another program.
class Resamples {
 public:
  /// @param count  number of values in the sample, > 0.
  /// @param resamples  number of resamples, > 0.
  Resamples(std::size_t count, std::size_t resamples, std::uint64_t seed, std::string_view stream);

  std::size_t size() const { return indices_.size() / count_; }
  std::size_t count() const { return count_; }
  /// Indices into the sample, from 0.
  std::span<const std::uint32_t> operator[](std::size_t resample) const {
    return std::span(indices_).subspan(resample * count_, count_);
  }
  /// One line per resample: indices into the sample, from 0, separated by commas.
  std::string csv() const;

 private:
  std::size_t count_;
  std::vector<std::uint32_t> indices_;
};

/// The statistic of each resample, sorted in ascending order.
/// @pre values.size() == resamples.count().
std::vector<double> bootstrap(std::span<const double> values, const Resamples& resamples,
                              const Statistic& statistic);

/// The percentile interval: quantiles of type 7 of the bootstrapped statistics (B. Efron and R. J.
/// Tibshirani, "An Introduction to the Bootstrap", 1993, chapter 13).
/// @param sorted  result of bootstrap(), not empty.
/// @param level  confidence level, in (0, 1).
Interval percentile_interval(std::span<const double> sorted, double level = kLevel);

/// The bias-corrected and accelerated (BCa) interval (same book, chapter 14); the jackknife gives
/// the acceleration. None if all resamples lie on one side of the statistic (for example because
/// all values are equal), or if there are fewer than two values.
/// @param sorted  result of bootstrap() for these values and this statistic.
std::optional<Interval> bca_interval(std::span<const double> values, std::span<const double> sorted,
                                     const Statistic& statistic, double level = kLevel);

double mean_of(std::span<const double> values);    ///< @pre not empty
double median_of(std::span<const double> values);  ///< @pre not empty

}  // namespace results::statistics
