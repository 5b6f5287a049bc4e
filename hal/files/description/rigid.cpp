#include "hal/files/description/rigid.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

namespace hal::files::description {

std::optional<std::string> why_not_solid(const Vec3& moments, const Vec3& products) {
  Eigen::Matrix3d tensor;
  tensor << moments.x, products.x, products.y, products.x, moments.y, products.z, products.y,
      products.z, moments.z;
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, Eigen::EigenvaluesOnly).eigenvalues();
  const double a = principal[0], b = principal[1], c = principal[2];
  const std::string list = fmt::format("{:.4g}, {:.4g} and {:.4g} kg m^2", a, b, c);
  if (!(a > 0)) return "no body has the principal moments " + list + ": they must be positive";
  constexpr double kRounded = 1e-6;
  if (!(c <= (a + b) + kRounded * c))
    return "no body has the principal moments " + list +
           ": the largest is more than the others' sum";
  return std::nullopt;
}

}  // namespace hal::files::description
