#include "results/statistics/regression.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "hal/types/check.h"
#include "results/statistics/distributions.h"

namespace results::statistics {
namespace {

constexpr double kNegligible = 1e-9;  // of the largest singular value
constexpr double kInvolved = 1e-6;    // of a unit vector of the null space

Eigen::Index index_of(std::size_t number) { return static_cast<Eigen::Index>(number); }

Eigen::MatrixXd matrix_of(const Observations& data) {
  Eigen::MatrixXd matrix(index_of(data.rows.size()), index_of(data.names.size()));
  for (std::size_t i = 0; i < data.rows.size(); ++i) {
    for (std::size_t j = 0; j < data.names.size(); ++j)
      matrix(index_of(i), index_of(j)) = data.rows[i][j];
  }
  return matrix;
}

/// The matrix with columns of length 1, and what they were divided by.
struct Scaled {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd lengths;
};

Scaled scaled(const Observations& data) {
  Scaled result{matrix_of(data), {}};
  result.lengths = result.matrix.colwise().norm().transpose();
  for (Eigen::Index j = 0; j < result.lengths.size(); ++j) {
    if (result.lengths(j) == 0) result.lengths(j) = 1;
    result.matrix.col(j) /= result.lengths(j);
  }
  return result;
}

Eigen::VectorXd values_of(const Observations& data) {
  return Eigen::Map<const Eigen::VectorXd>(data.values.data(), index_of(data.values.size()));
}

}  // namespace

std::vector<std::string> unidentified(const Observations& data) {
  std::vector<std::string> names;
  if (data.rows.empty()) return data.names;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled(data).matrix, Eigen::ComputeFullV);
  const auto& singular = svd.singularValues();
  for (std::size_t j = 0; j < data.names.size(); ++j) {
    for (Eigen::Index k = 0; k < index_of(data.names.size()); ++k) {
      const bool is_null = k >= singular.size() || singular(k) <= kNegligible * singular(0);
      if (!is_null || std::abs(svd.matrixV()(index_of(j), k)) < kInvolved) continue;
      names.push_back(data.names[j]);
      break;
    }
  }
  return names;
}

LinearFit linear_fit(const Observations& data, double level) {
  BARAKA_CHECK(data.rows.size() > data.names.size());
  const Scaled design = scaled(data);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(design.matrix,
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd values = values_of(data);
  const Eigen::VectorXd unit = svd.solve(values);
  const Eigen::VectorXd residual = values - design.matrix * unit;
  LinearFit fit;
  fit.degrees = data.rows.size() - data.names.size();
  const auto degrees = static_cast<double>(fit.degrees);
  fit.sd = std::sqrt(residual.squaredNorm() / degrees);
  const double t = student_t_quantile((1 + level) / 2, degrees);
  const Eigen::MatrixXd inverse = svd.matrixV() * svd.singularValues().cwiseInverse().asDiagonal();
  for (std::size_t j = 0; j < data.names.size(); ++j) {
    const double length = design.lengths(index_of(j));
    const double value = unit(index_of(j)) / length;
    const double half = t * fit.sd * inverse.row(index_of(j)).norm() / length;
    fit.coefficients.push_back({data.names[j], value, {value - half, value + half}});
  }
  return fit;
}

double rms_residual(const Observations& data, const LinearFit& fit) {
  double sum = 0;
  for (std::size_t i = 0; i < data.rows.size(); ++i) {
    double residual = data.values[i];
    for (std::size_t j = 0; j < fit.coefficients.size(); ++j)
      residual -= fit.coefficients[j].value * data.rows[i][j];
    sum += residual * residual;
  }
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, data.rows.size())));
}

}  // namespace results::statistics
