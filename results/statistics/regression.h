#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/statistics/interval.h"

namespace results::statistics {

/// Observations of a value that is linear in unknown coefficients, but for an error.
struct Observations {
  std::vector<std::string> names;  ///< Of the coefficients.
  std::vector<std::vector<double>>
      rows;                    ///< What each coefficient is multiplied by; as many as names.
  std::vector<double> values;  ///< One for each row.
};

/// Coefficients that the rows do not tell apart: those of the null space of the matrix, by its
/// singular values. Columns are scaled to length 1; what is below 1e-9 of the largest singular
/// value counts as 0. Empty: each coefficient is identified. With fewer rows than coefficients some
/// are not.
std::vector<std::string> unidentified(const Observations& data);

struct Coefficient {
  std::string name;
  double value = 0;
  Interval interval;  ///< As in LinearFit.
};

/// Ordinary least squares (by a singular value decomposition, Eigen), with intervals by Student's t
/// with n - p degrees of freedom: value +- t((1 + level) / 2, n - p) s sqrt((X'X)^-1_ii), where s^2
/// is the sum of squared residuals over n - p. Exact for independent normal errors of equal
/// variance (N. R. Draper, H. Smith, "Applied Regression Analysis", 3rd ed., 1998, 5.1).
struct LinearFit {
  std::vector<Coefficient> coefficients;
  double sd = 0;            ///< s
  std::size_t degrees = 0;  ///< n - p
};

/// @pre unidentified(data) is empty, and there are more rows than coefficients.
LinearFit linear_fit(const Observations& data, double level = kLevel);

/// Root mean square of value - fit.
double rms_residual(const Observations& data, const LinearFit& fit);

}  // namespace results::statistics
