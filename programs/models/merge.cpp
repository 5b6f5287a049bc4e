#include "programs/models/merge.h"

#include <fmt/format.h>

#include <cmath>

#include "hal/files/description/rigid.h"

namespace programs::models {

Inertial merged(const std::vector<PlacedInertial>& parts) {
  Inertial sum{0, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero(), parts.front().inertial.line};
  for (const auto& [pose, part] : parts) {
    sum.mass += part.mass;
    sum.centre += part.mass * (pose * part.centre);
  }
  sum.centre /= sum.mass;
  for (const auto& [pose, part] : parts) {
    const Eigen::Vector3d to = pose * part.centre - sum.centre;
    sum.tensor +=
        pose.linear() * part.tensor * pose.linear().transpose() +
        part.mass * (to.squaredNorm() * Eigen::Matrix3d::Identity() - to * to.transpose());
  }
  return sum;
}

void check_solid(const Inertial& inertial, const std::string& link) {
  const Eigen::Matrix3d& t = inertial.tensor;
  if (!(inertial.mass > 0) || !std::isfinite(inertial.mass) || !t.allFinite() ||
      !inertial.centre.allFinite())
    throw ModelError(inertial.line,
                     fmt::format("the link '{}': its mass must be positive and finite", link));
  const auto why = hal::files::description::why_not_solid({t(0, 0), t(1, 1), t(2, 2)},
                                                          {t(0, 1), t(0, 2), t(1, 2)});
  if (why) throw ModelError(inertial.line, fmt::format("the link '{}': {}", link, *why));
}

}  // namespace programs::models
