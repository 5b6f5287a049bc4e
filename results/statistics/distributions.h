#pragma once

namespace results::statistics {

/// The distributions that intervals are made from. Boost.Math (Debian's libboost-dev); relative
/// error below 1e-12, held against R by tests/statistics.

/// Of Student's t distribution. @param p  in (0, 1). @param degrees  of freedom, > 0.
double student_t_quantile(double p, double degrees);
/// P(T <= t).
double student_t_cdf(double t, double degrees);

/// Of the standard normal distribution. @param p  in (0, 1).
double normal_quantile(double p);
double normal_cdf(double z);

/// P(B <= successes) for B of `trials` trials with probability p each; 0 below 0 successes.
/// @param p  in [0, 1].
double binomial_cdf(int successes, int trials, double p);

}  // namespace results::statistics
