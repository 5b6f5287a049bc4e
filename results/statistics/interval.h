#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace results::statistics {

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

/// Which values a quantity can have, and so its mean.
struct Support {
  enum class Kind : std::uint8_t {
    kReal,         ///< Any.
    kNotNegative,  ///< 0 or more.
    kCount,        ///< How often something happened: 0, 1, 2, …
    kShare,        ///< 0 .. 1
  };
  Kind kind = Kind::kReal;
  /// Of shares: of how many trials all values together tell; none: of something else, like time.
  std::optional<double> trials{};
};

/// The confidence interval of a mean, within what the support allows and never cut off there.
///
/// kReal: Student's t, as above. Else all mu that a t test of the mean would not refuse if it took
/// the variance of a value to be phi V(mu), as generalised linear models do, V(mu) = mu (1 - mu) of
/// shares and mu of the others, and phi from the sample: sd^2 / V(mean) (R. W. M. Wedderburn,
/// "Quasi-likelihood Functions, Generalized Linear Models, and the Gauss-Newton Method", Biometrika
/// 61(3), 1974). Solved for mu,
///
///   (mean - mu)^2 <= k V(mu),   k = t((1 + level) / 2, n - 1)^2 sd^2 / (n V(mean)),
///
/// is for shares the interval of E. B. Wilson ("Probable Inference, the Law of Succession, and
/// Statistical Inference", Journal of the American Statistical Association 22, 1927) with the
/// effective number of trials of E. L. Korn and B. I. Graubard ("Confidence Intervals for
/// Proportions with Small Expected Number of Positive Counts Estimated from Survey Data", Survey
/// Methodology 24(2), 1998): runs are the clusters. As there, never more trials than there are: k
/// >= z^2 / trials. If all counts are 0, phi is 1, as of events that come one by one (Poisson). Far
/// from the ends of the support it is Student's interval.
///
/// None for fewer than two values. Values outside the support: as kReal.
std::optional<Interval> mean_interval(std::span<const double> values, const Support& support,
                                      double level = kLevel);

}  // namespace results::statistics
