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

/// What is asked of a sample.
using Statistic = std::function<double(std::span<const double>)>;

/// Which values each resample consists of: `count` of them per resample, drawn with replacement
/// from the named stream (hal::RandomStream), so that the same name and seed give the same ones
/// on every machine, and another program can be given them.
class Resamples {
 public:
  /// @param count  values of a sample, > 0. @param resamples  > 0.
  Resamples(std::size_t count, std::size_t resamples, std::uint64_t seed, std::string_view stream);

  std::size_t size() const { return indices_.size() / count_; }
  std::size_t count() const { return count_; }
  /// Places in the sample, from 0.
  std::span<const std::uint32_t> operator[](std::size_t resample) const {
    return std::span(indices_).subspan(resample * count_, count_);
  }
  /// One line per resample: places in the sample, from 0, with commas between them.
  std::string csv() const;

 private:
  std::size_t count_;
  std::vector<std::uint32_t> indices_;
};

/// The statistic of each resample, ascending.
/// @pre values.size() == resamples.count().
std::vector<double> bootstrap(std::span<const double> values, const Resamples& resamples,
                              const Statistic& statistic);

/// The percentile interval: quantiles of type 7 of the bootstrapped statistics (B. Efron and R. J.
/// Tibshirani, "An Introduction to the Bootstrap", 1993, chapter 13).
/// @param sorted  of bootstrap(), not empty.
Interval percentile_interval(std::span<const double> sorted, double level = kLevel);

/// The bias-corrected and accelerated interval (the same, chapter 14), its acceleration from the
/// jackknife. None if the resamples lie all on one side of the statistic, as those of equal values
/// do, or if there are fewer than two values.
/// @param sorted  of bootstrap() of these values with this statistic.
std::optional<Interval> bca_interval(std::span<const double> values, std::span<const double> sorted,
                                     const Statistic& statistic, double level = kLevel);

double mean_of(std::span<const double> values);    ///< @pre not empty
double median_of(std::span<const double> values);  ///< @pre not empty

}  // namespace results::statistics
