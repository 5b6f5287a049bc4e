#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace sim::statistics {

/// The level of confidence where none is asked for.
inline constexpr double kLevel = 0.95;

/// Fewer replications than this are too few for an interval to be trusted: its half-width is then
/// more than 1.3 standard deviations, and it is itself a guess (A. M. Law, "Simulation Modeling
/// and Analysis", asks for three to five at the very least).
inline constexpr std::size_t kFewestRuns = 5;

/// A confidence interval, in the unit of the values.
struct Interval {
  double low = 0, high = 0;
};

/// How many values, their mean, and their standard deviation (of a sample: divided by count - 1; 0
/// for one value).
struct Moments {
  std::size_t count = 0;
  double mean = 0, sd = 0;
};

/// None for no values. @pre all finite.
std::optional<Moments> moments(std::span<const double> values);

/// The confidence interval of a mean by Student's t: mean +- t((1 + level) / 2, n - 1) sd /
/// sqrt(n). Exact for independent normal values; the values of independent replications are close
/// to it if each is itself a mean of many. None for fewer than two values.
/// @param level  in (0, 1).
std::optional<Interval> mean_interval(std::span<const double> values, double level = kLevel);

}  // namespace sim::statistics
