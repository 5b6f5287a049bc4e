#include "programs/models/upright.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/types/math.h"
#include "hal/types/overloaded.h"

namespace programs::models {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using hal::Overloaded;

constexpr double kUpright = 1 - 1e-9;  ///< Cosine of 2.6 arc minutes.
constexpr double kThinnest = 1e-3;     ///< m, what a robot file accepts

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

std::vector<Vector3d> corners_of(const Shape& shape) {
  if (shape.kind == Shape::Kind::kPoints) return shape.points;
  std::vector<Vector3d> corners;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5})
        corners.emplace_back(shape.size.cwiseProduct(Vector3d(x, y, z)));
  return corners;
}

/// Corners of the convex hull, counter-clockwise (A. M. Andrew, "Another Efficient Algorithm for
/// Convex Hulls in Two Dimensions", 1979).
std::vector<Vector2d> hull_of(std::vector<Vector2d> points) {
  std::ranges::sort(points, [](const Vector2d& a, const Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vector2d> hull;
  const auto add = [&hull](const Vector2d& point, std::size_t kept) {
    while (hull.size() >= kept + 2 &&
           cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0)
      hull.pop_back();
    hull.push_back(point);
  };
  for (const Vector2d& point : points) add(point, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower);
  hull.pop_back();
  return hull;
}

struct Rectangle {
  Vector2d centre, size;
  Vector2d along;  ///< Unit vector of its first edge.
};

/// The rectangle around a hull along one of its edges.
Rectangle around(const std::vector<Vector2d>& hull, const Vector2d& along) {
  const Vector2d across(-along.y(), along.x());
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vector2d& point : hull) {
    const Vector2d own(along.dot(point), across.dot(point));
    low = low.cwiseMin(own);
    high = high.cwiseMax(own);
  }
  const Vector2d middle = 0.5 * (low + high);
  return {middle.x() * along + middle.y() * across, high - low, along};
}

/// One edge of the rectangle of least area lies on one of the hull (H. Freeman, R. Shapira,
/// "Determining the Minimum-Area Encasing Rectangle for an Arbitrary Closed Curve", 1975).
Rectangle smallest_rectangle(const std::vector<Vector2d>& hull) {
  Rectangle best = around(hull, Vector2d::UnitX());
  for (std::size_t i = 0; i < hull.size() && hull.size() > 1; ++i) {
    const Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
    const double length = edge.norm();
    if (!(length > 0)) continue;
    const Rectangle one = around(hull, edge / length);
    if (one.size.prod() < best.size.prod() * (1 - 1e-12)) best = one;
  }
  return best;
}

struct Circle {
  Vector2d centre;
  double radius = 0;
  bool holds(const Vector2d& p) const { return (p - centre).norm() <= radius * (1 + 1e-12); }
};

Circle through(const Vector2d& a, const Vector2d& b) {
  return {0.5 * (a + b), 0.5 * (a - b).norm()};
}

Circle through(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const Vector2d u = b - a, v = c - a;
  const double twice = 2 * cross(u, v);
  if (twice == 0) return through(a, (u.norm() > v.norm()) ? b : c);
  const Vector2d centre(v.y() * u.squaredNorm() - u.y() * v.squaredNorm(),
                        u.x() * v.squaredNorm() - v.x() * u.squaredNorm());
  return {a + centre / twice, (centre / twice).norm()};
}

/// E. Welzl, "Smallest enclosing disks (balls and ellipsoids)", 1991, without its random order: a
/// hull has few corners.
Circle smallest_circle(const std::vector<Vector2d>& hull) {
  Circle best{hull.front(), 0};
  for (std::size_t i = 1; i < hull.size(); ++i) {
    if (best.holds(hull[i])) continue;
    best = {hull[i], 0};
    for (std::size_t j = 0; j < i; ++j) {
      if (best.holds(hull[j])) continue;
      best = through(hull[i], hull[j]);
      for (std::size_t k = 0; k < j; ++k)
        if (!best.holds(hull[k])) best = through(hull[i], hull[j], hull[k]);
    }
  }
  return best;
}

Upright around_points(const std::vector<Vector3d>& points, const Isometry3d& pose) {
  std::vector<Vector2d> shadow;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vector3d& point : points) {
    const Vector3d at = pose * point;
    shadow.emplace_back(at.head<2>());
    low = std::min(low, at.z());
    high = std::max(high, at.z());
  }
  const std::vector<Vector2d> hull = hull_of(std::move(shadow));
  const Rectangle box = smallest_rectangle(hull);
  const Circle circle = smallest_circle(hull);
  if (hal::math::kPi * circle.radius * circle.radius < box.size.prod())
    return UprightCylinder{circle.centre, circle.radius, low, high};
  return UprightBox{{box.centre.x(), box.centre.y(), 0.5 * (low + high)},
                    {box.size.x(), box.size.y(), high - low},
                    hal::math::atan2(box.along.y(), box.along.x())};
}

/// A box that stands on a face, if it does.
Upright of_box(const Shape& shape, const Isometry3d& pose) {
  for (int up = 0; up < 3; ++up) {
    if (std::abs(pose.linear()(2, up)) < kUpright) continue;
    const int along = (up + 1) % 3, across = (up + 2) % 3;
    const Vector3d x = pose.linear().col(up == 2 ? 0 : along);
    return UprightBox{pose.translation(),
                      {shape.size[along], shape.size[across], shape.size[up]},
                      hal::math::atan2(x.y(), x.x())};
  }
  return around_points(corners_of(shape), pose);
}

/// @param rounded  m, radius of half balls at the ends.
Upright of_rod(const Shape& shape, const Isometry3d& pose, double rounded) {
  const Vector3d at = pose.translation(), axis = pose.linear().col(2);
  const double r = shape.radius, c = std::abs(axis.z());
  const double s = std::sqrt(std::max(0.0, 1 - c * c));
  const double flat = rounded > 0 ? 1 : s, lying = rounded > 0 ? 1 : c;
  const double height = shape.length * c + 2 * r * flat;
  if (c >= kUpright)
    return UprightCylinder{at.head<2>(), r, at.z() - height / 2, at.z() + height / 2};
  return UprightBox{
      at, {shape.length * s + 2 * r * lying, 2 * r, height}, hal::math::atan2(axis.y(), axis.x())};
}

Upright of_ellipsoid(const Shape& shape, const Isometry3d& pose) {
  const Vector3d half = (pose.linear() * shape.size.asDiagonal()).rowwise().norm();
  return UprightBox{pose.translation(), 2 * half, 0};
}

}  // namespace

Upright upright(const Shape& shape, const Isometry3d& pose) {
  switch (shape.kind) {
    case Shape::Kind::kBox:
      return of_box(shape, pose);
    case Shape::Kind::kCylinder:
      return of_rod(shape, pose, 0);
    case Shape::Kind::kCapsule:
      return of_rod(shape, pose, shape.radius);
    case Shape::Kind::kSphere: {
      const Vector3d at = pose.translation();
      return UprightCylinder{at.head<2>(), shape.radius, at.z() - shape.radius,
                             at.z() + shape.radius};
    }
    case Shape::Kind::kEllipsoid:
      return of_ellipsoid(shape, pose);
    case Shape::Kind::kPoints:
      break;
  }
  return around_points(shape.points, pose);
}

Heights heights(const Upright& shape) {
  return std::visit(
      Overloaded{[](const UprightBox& c) {
                   return Heights{c.centre.z() - c.size.z() / 2, c.centre.z() + c.size.z() / 2};
                 },
                 [](const UprightCylinder& c) {
                   return Heights{c.bottom, c.top};
                 }},
      shape);
}

Vector3d centre_of(const Upright& shape) {
  return std::visit(Overloaded{[](const UprightBox& c) { return c.centre; },
                               [](const UprightCylinder& c) {
                                 return Vector3d(c.centre.x(), c.centre.y(),
                                                 (c.bottom + c.top) / 2);
                               }},
                    shape);
}

bool cut_at_ground(Upright& shape) {
  Heights z = heights(shape);
  if (z.high < kThinnest) return false;
  z.low = std::max(0.0, z.low);
  z.high = std::max(z.high, z.low + kThinnest);
  std::visit(Overloaded{[&z](UprightBox& c) {
                          c.centre.z() = 0.5 * (z.low + z.high);
                          c.size = Vector3d(c.size.x(), c.size.y(), z.high - z.low)
                                       .cwiseMax(Vector3d::Constant(kThinnest));
                        },
                        [&z](UprightCylinder& c) {
                          c.radius = std::max(c.radius, kThinnest);
                          c.bottom = z.low;
                          c.top = z.high;
                        }},
             shape);
  return true;
}

double reach(const Shape& shape, const Isometry3d& pose, const Vector3d& at,
             const Vector3d& along) {
  const auto distance = [&](const Vector3d& point) {
    const Vector3d to = point - at;
    return (to - along.dot(to) * along).norm();
  };
  if (shape.kind == Shape::Kind::kSphere) return distance(pose.translation()) + shape.radius;
  if (shape.kind == Shape::Kind::kBox || shape.kind == Shape::Kind::kPoints) {
    double farthest = 0;
    for (const Vector3d& corner : corners_of(shape))
      farthest = std::max(farthest, distance(pose * corner));
    return farthest;
  }
  // Cylinders and capsules: those of wheels turn about their own axis.
  return distance(pose.translation()) + std::max(shape.radius, shape.size.maxCoeff());
}

}  // namespace programs::models
