#pragma once

namespace results::statistics {

/// Distributions from which intervals are computed, by Boost.Math (Debian's libboost-dev). Relative
/// error below 1e-12: tests/statistics compares them with R.

/// Quantile of Student's t distribution. @param p  in (0, 1). @param degrees  of freedom, > 0.
double student_t_quantile(double p, double degrees);
/// P(T <= t) for T with Student's t distribution. @param degrees  of freedom, > 0.
double student_t_cdf(double t, double degrees);

/// Quantile of the standard normal distribution. @param p  in (0, 1).
double normal_quantile(double p);
double normal_cdf(double z);

/// P(B <= successes), where B is the number of successes in `trials` trials of probability p each.
/// 0 if `successes` is negative.
/// @param p  in [0, 1].
double binomial_cdf(int successes, int trials, double p);

}  // namespace results::statistics
