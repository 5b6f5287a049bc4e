#include "hal/node/devices/wheel_drive.h"

#include <fmt/core.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hal/types/check.h"
#include "hal/types/math.h"

namespace hal::node::devices {
namespace {

using Row = WheelDrive::Row;

/// A direction shorter than this (m, and rad per metre) is rounding: files give angles in degrees.
constexpr double kNothing = 1e-9;

/// A motion, or a constraint on one: (vx, vy, omega).
using Vector = Eigen::RowVector3d;
/// Row-major: Eigen then sums from the left, as dot() does.
using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

double dot(const Row& a, const Row& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Velocity of the body at a wheel along a direction, as a row of (vx, vy, omega).
Vector along(const Vec2& direction, const Vec2& position) {
  return {direction.x, direction.y, direction.y * position.x - direction.x * position.y};
}

Vector row_of(const Wheel& wheel) {
  const double radius = wheel.radius * math::cos(wheel.roller_angle);
  return along({-math::sin(wheel.slip_heading()), math::cos(wheel.slip_heading())},
               wheel.position) /
         radius;
}

/// The rest of a row without its components along orthogonal unit rows.
Vector without(Vector row, const std::vector<Vector>& units) {
  for (const Vector& unit : units) row -= row.dot(unit) * unit;
  return row;
}

/// Orthogonal unit rows that span the motions ruled out by the fixed wheels (Gram-Schmidt).
std::vector<Vector> constraints(const std::vector<Wheel>& wheels) {
  std::vector<Vector> units;
  for (const Wheel& wheel : wheels) {
    if (wheel.type != WheelType::kFixed) continue;
    const Vector rest = without(
        along({math::cos(wheel.axle_heading), math::sin(wheel.axle_heading)}, wheel.position),
        units);
    const double length = rest.norm();
    if (length >= kNothing) units.emplace_back(rest / length);
  }
  return units;
}

/// Inverse of a symmetric matrix from its cofactors. @throws std::invalid_argument  it is singular.
Matrix invert(const Matrix& m) {
  const double determinant = m.determinant();
  // For a singular matrix rounding leaves about 1e-16 of the diagonal's product.
  if (!(determinant > 1e-9 * m.diagonal().prod()))
    throw std::invalid_argument("wheels: the axles leave a direction of the body undriven");
  Matrix cofactors;
  cofactors << m.row(1).cross(m.row(2)), m.row(2).cross(m.row(0)), m.row(0).cross(m.row(1));
  // Division, because inverse() multiplies by 1 / determinant, which changes the last bit of
  // speeds.
  return cofactors / determinant;
}

/// Pseudo-inverse of the rows within the feasible motions: with the projections P onto them and Q
/// onto the motions ruled out, (P J^T J P + s^2 Q)^-1 P J^T. The term in Q only makes it
/// invertible.
std::vector<Row> pseudo_inverse(const std::vector<Vector>& rows,
                                const std::vector<Vector>& ruled_out) {
  std::vector<Vector> feasible;
  feasible.reserve(rows.size());
  for (const Vector& row : rows) feasible.push_back(without(row, ruled_out));
  std::vector<Vector> all = feasible;
  const double scale = rows.front().norm();  // gives Q the magnitude of the other rows
  for (const Vector& unit : ruled_out) all.emplace_back(scale * unit);
  Matrix normal = Matrix::Zero();  // of the normal equations
  for (const Vector& row : all) normal += row.transpose() * row;
  const Matrix inverse = invert(normal);
  std::vector<Row> columns;
  columns.reserve(feasible.size());
  for (const Vector& row : feasible) {
    const Eigen::Vector3d column = inverse * row.transpose();
    columns.push_back({column[0], column[1], column[2]});
  }
  return columns;
}

Row as_row(const Twist2& twist) { return {twist.vx, twist.vy, twist.omega}; }

}  // namespace

WheelDrive::WheelDrive(const std::vector<Wheel>& wheels) {
  std::vector<Vector> rows;
  for (const Wheel& wheel : wheels) {
    if (!wheel.is_driven()) continue;
    if (!(wheel.radius > 0) || !(wheel.max_speed > 0))
      throw std::invalid_argument(
          fmt::format("wheels: radius {} m, max_speed {} rad/s: both must be positive",
                      wheel.radius, wheel.max_speed));
    max_wheel_speed_ =
        body_to_wheel_.empty() ? wheel.max_speed : std::min(max_wheel_speed_, wheel.max_speed);
    const Vector& row = rows.emplace_back(row_of(wheel));
    body_to_wheel_.push_back({row[0], row[1], row[2]});
  }
  if (body_to_wheel_.empty()) throw std::invalid_argument("wheels: none is driven");
  const std::vector<Vector> ruled_out = constraints(wheels);
  degrees_of_freedom_ = 3 - static_cast<int>(ruled_out.size());
  if (degrees_of_freedom_ == 0)
    throw std::invalid_argument("wheels: the fixed wheels let the body go nowhere");
  wheel_to_body_ = pseudo_inverse(rows, ruled_out);
}

Twist2 WheelDrive::limits() const {
  Row fastest{};
  for (const Twist2& axis : {Twist2{1, 0, 0}, Twist2{0, 1, 0}, Twist2{0, 0, 1}}) {
    const Twist2 motion = project(axis);
    double turning = 0;
    for (const Row& row : body_to_wheel_)
      turning = std::max(turning, std::abs(dot(row, as_row(motion))));
    if (turning < kNothing * max_wheel_speed_) continue;
    const double factor = max_wheel_speed_ / turning;
    for (std::size_t i = 0; i < 3; ++i)
      fastest[i] = std::max(fastest[i], factor * std::abs(as_row(motion)[i]));
  }
  return {fastest[0], fastest[1], fastest[2]};
}

std::vector<double> WheelDrive::wheel_speeds(const Twist2& twist) const {
  std::vector<double> speeds(body_to_wheel_.size());
  wheel_speeds(twist, speeds);
  return speeds;
}

void WheelDrive::wheel_speeds(const Twist2& twist, std::span<double> speeds) const {
  BARAKA_CHECK(speeds.size() == body_to_wheel_.size());
  const Row body = as_row(twist);
  for (std::size_t i = 0; i < speeds.size(); ++i) speeds[i] = dot(body_to_wheel_[i], body);
}

Twist2 WheelDrive::body_velocity(std::span<const double> speeds) const {
  BARAKA_CHECK(speeds.size() == wheel_to_body_.size());
  Twist2 twist;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    twist.vx += wheel_to_body_[i][0] * speeds[i];
    twist.vy += wheel_to_body_[i][1] * speeds[i];
    twist.omega += wheel_to_body_[i][2] * speeds[i];
  }
  return twist;
}

Twist2 WheelDrive::project(const Twist2& twist) const {
  if (degrees_of_freedom_ == 3) return twist;
  Row motion{};
  for (std::size_t i = 0; i < body_to_wheel_.size(); ++i) {
    const double speed = dot(body_to_wheel_[i], as_row(twist));
    for (std::size_t k = 0; k < 3; ++k) motion[k] += wheel_to_body_[i][k] * speed;
  }
  return {motion[0], motion[1], motion[2]};
}

WheelDrive::Limited WheelDrive::saturate(const Twist2& twist) const {
  const Row body = as_row(project(twist));
  const Row left_out{twist.vx - body[0], twist.vy - body[1], twist.omega - body[2]};
  const double size = std::sqrt(dot(as_row(twist), as_row(twist)));
  const bool restricted = std::sqrt(dot(left_out, left_out)) > kNothing * size;
  double fastest = 0;
  for (const Row& row : body_to_wheel_) fastest = std::max(fastest, std::abs(dot(row, body)));
  const double factor = fastest <= max_wheel_speed_ ? 1 : max_wheel_speed_ / fastest;
  return {{factor * body[0], factor * body[1], factor * body[2]}, factor < 1, restricted};
}

}  // namespace hal::node::devices
