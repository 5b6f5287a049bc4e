#include "programs/models/wheel_parts.h"

#include <fmt/format.h>

#include <algorithm>

#include "programs/models/upright.h"

namespace programs::models {
namespace {

std::optional<double> friction_of_wheel(const Collision& collision, std::vector<Note>& notes) {
  if (!collision.mu) return std::nullopt;
  if (*collision.mu > 0 && *collision.mu <= kHighestFriction) return collision.mu;
  notes.push_back(
      {collision.line, fmt::format("the friction {} of '{}', which is not above 0 and at "
                                   "most {}",
                                   *collision.mu, collision.name, kHighestFriction)});
  return std::nullopt;
}

}  // namespace

WheelParts parts_of_wheel(const Model& model, const WheelOfLink& wheels, const Joint& joint,
                          std::vector<Note>& notes) {
  WheelParts parts;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double shapes = 0;
  for (const ModelLink& link : model.links) {
    const auto of = wheels.find(link.name);
    if (of == wheels.end() || of->second != &joint) continue;
    if (link.inertial) parts.mass += link.inertial->mass;
    for (const Collision& one : link.collisions) {
      const Eigen::Isometry3d pose = link.pose * one.pose;
      parts.radius = std::max(parts.radius, reach(one.shape, pose, joint.origin, joint.axis));
      middle += centre_of(upright(one.shape, pose));
      ++shapes;
      if (!parts.mu) parts.mu = friction_of_wheel(one, notes);
    }
  }
  const double along = shapes == 0 ? 0 : joint.axis.dot(middle / shapes - joint.origin);
  parts.centre = joint.origin + along * joint.axis;
  return parts;
}

}  // namespace programs::models
