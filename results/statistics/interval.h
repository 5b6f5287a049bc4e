#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace results::statistics {

/// The default confidence level.
inline constexpr double kLevel = 0.95;

/// An interval from fewer replications than this cannot be trusted: its half-width exceeds 1.3
/// standard deviations and is itself a rough estimate (A. M. Law, "Simulation Modeling and
/// Analysis", asks for at least three to five).
inline constexpr std::size_t kFewestRuns = 5;

/// A confidence interval, in the unit of the values.
struct Interval {
  double low = 0, high = 0;
};

/// Number of values, their mean and their sample standard deviation (divisor count - 1; 0 for one
/// value).
struct Moments {
  std::size_t count = 0;
  double mean = 0, sd = 0;
};

/// None if there are no values. @pre All values are finite.
std::optional<Moments> moments(std::span<const double> values);

/// The confidence interval of a mean by Student's t: mean +- t((1 + level) / 2, n - 1) sd /
/// sqrt(n). Exact for independent normal values. The values of independent replications are nearly
/// normal if each is itself a mean of many. None for fewer than two values.
/// @param level  in (0, 1).
std::optional<Interval> mean_interval(std::span<const double> values, double level = kLevel);

/// The values that a quantity, and therefore its mean, can take.
struct Support {
  enum class Kind : std::uint8_t {
    kReal,         ///< Any real number.
    kNotNegative,  ///< 0 or more.
    kCount,        ///< A number of occurrences: 0, 1, 2, …
    kShare,        ///< 0 .. 1
  };
  Kind kind = Kind::kReal;
  /// kShare only: the number of trials behind all values together; none: the share is not one of
  /// trials but, for example, of time.
  std::optional<double> trials{};
};

/// The confidence interval of a mean. It lies within the support by construction, not by clipping.
///
/// kReal: Student's t, as above. Otherwise all mu that a t test of the mean does not reject when
/// the variance of a value is phi V(mu), as in generalised linear models: V(mu) = mu (1 - mu) for
/// shares, mu for the others, and phi = sd^2 / V(mean), estimated from the sample (R. W. M.
/// Wedderburn, "Quasi-likelihood Functions, Generalized Linear Models, and the Gauss-Newton
/// Method", Biometrika 61(3), 1974):
///
///   (mean - mu)^2 <= k V(mu),   k = t((1 + level) / 2, n - 1)^2 sd^2 / (n V(mean)).
///
/// For shares, solving this for mu gives the interval of E. B. Wilson ("Probable Inference, the Law
/// of Succession, and Statistical Inference", Journal of the American Statistical Association 22,
/// 1927) with the effective number of trials of E. L. Korn and B. I. Graubard ("Confidence
/// Intervals for Proportions with Small Expected Number of Positive Counts Estimated from Survey
/// Data", Survey Methodology 24(2), 1998), whose clusters are the runs. As in that paper, the
/// effective number never exceeds the real number of trials: k >= z^2 / trials. If all counts are
/// 0, phi is 1, as for a Poisson process. Far from the ends of the support the interval approaches
/// Student's.
///
/// None for fewer than two values. If a value lies outside the support, as kReal.
std::optional<Interval> mean_interval(std::span<const double> values, const Support& support,
                                      double level = kLevel);

}  // namespace results::statistics
