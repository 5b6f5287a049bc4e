#include "hal/node/devices/wheel_drive.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hal/types/check.h"
#include "hal/types/math.h"

namespace hal::node::devices {
namespace {

using Row = WheelDrive::Row;

/// Below it (m, and rad by the metre) a direction is rounding: files give angles in degrees.
constexpr double kNothing = 1e-9;

Row cross(const Row& a, const Row& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Row& a, const Row& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Velocity of the body at a wheel along a direction, as a row of (vx, vy, omega).
Row along(const Vec2& direction, const Vec2& position) {
  return {direction.x, direction.y, direction.y * position.x - direction.x * position.y};
}

Row row_of(const Wheel& wheel) {
  const double radius = wheel.radius * math::cos(wheel.roller_angle);
  const Row row =
      along({-math::sin(wheel.slip_heading()), math::cos(wheel.slip_heading())}, wheel.position);
  return {row[0] / radius, row[1] / radius, row[2] / radius};
}

/// What is left of a row without its shares in orthogonal unit rows.
Row without(Row row, const std::vector<Row>& units) {
  for (const Row& unit : units) {
    const double share = dot(row, unit);
    for (std::size_t i = 0; i < 3; ++i) row[i] -= share * unit[i];
  }
  return row;
}

/// Orthogonal unit rows that span what the fixed wheels rule out (Gram and Schmidt).
std::vector<Row> constraints(const std::vector<Wheel>& wheels) {
  std::vector<Row> units;
  for (const Wheel& wheel : wheels) {
    if (wheel.type != WheelType::kFixed) continue;
    Row rest = without(
        along({math::cos(wheel.axle_heading), math::sin(wheel.axle_heading)}, wheel.position),
        units);
    const double length = std::sqrt(dot(rest, rest));
    if (length < kNothing) continue;
    for (double& value : rest) value /= length;
    units.push_back(rest);
  }
  return units;
}

/// Sum over the wheels of row times row transposed: the normal equations' matrix.
std::array<Row, 3> gram(const std::vector<Row>& rows) {
  std::array<Row, 3> sum{};
  for (const Row& row : rows)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) sum[i][j] += row[i] * row[j];
  return sum;
}

/// Rows of the inverse of a symmetric matrix, from its cofactors. @throws if it is singular.
std::array<Row, 3> invert(const std::array<Row, 3>& m) {
  const Row c0 = cross(m[1], m[2]);
  const double determinant = dot(m[0], c0);
  // For a singular matrix rounding leaves about 1e-16 of the diagonal's product.
  if (!(determinant > 1e-9 * m[0][0] * m[1][1] * m[2][2]))
    throw std::invalid_argument("wheels: the axles leave a direction of the body undriven");
  std::array<Row, 3> inverse{c0, cross(m[2], m[0]), cross(m[0], m[1])};
  for (Row& row : inverse)
    for (double& value : row) value /= determinant;
  return inverse;
}

/// Pseudo-inverse of the rows among the feasible motions: with P the projection on them and Q that
/// on what is ruled out, (P J^T J P + s^2 Q)^-1 P J^T. The term in Q only makes it invertible.
std::vector<Row> pseudo_inverse(const std::vector<Row>& rows, const std::vector<Row>& ruled_out) {
  std::vector<Row> feasible;
  feasible.reserve(rows.size());
  for (const Row& row : rows) feasible.push_back(without(row, ruled_out));
  std::vector<Row> all = feasible;
  const double scale = std::sqrt(dot(rows.front(), rows.front()));  // of the same magnitude
  for (const Row& unit : ruled_out)
    all.push_back({scale * unit[0], scale * unit[1], scale * unit[2]});
  const auto inverse = invert(gram(all));
  std::vector<Row> columns;
  columns.reserve(feasible.size());
  for (const Row& row : feasible)
    columns.push_back({dot(inverse[0], row), dot(inverse[1], row), dot(inverse[2], row)});
  return columns;
}

Row as_row(const Twist2& twist) { return {twist.vx, twist.vy, twist.omega}; }

}  // namespace

WheelDrive::WheelDrive(const std::vector<Wheel>& wheels) {
  for (const Wheel& wheel : wheels) {
    if (!wheel.is_driven()) continue;
    if (!(wheel.radius > 0) || !(wheel.max_speed > 0))
      throw std::invalid_argument(
          fmt::format("wheels: radius {} m, max_speed {} rad/s: both must be positive",
                      wheel.radius, wheel.max_speed));
    max_wheel_speed_ =
        body_to_wheel_.empty() ? wheel.max_speed : std::min(max_wheel_speed_, wheel.max_speed);
    body_to_wheel_.push_back(row_of(wheel));
  }
  if (body_to_wheel_.empty()) throw std::invalid_argument("wheels: none is driven");
  const std::vector<Row> ruled_out = constraints(wheels);
  degrees_of_freedom_ = 3 - static_cast<int>(ruled_out.size());
  if (degrees_of_freedom_ == 0)
    throw std::invalid_argument("wheels: the fixed wheels let the body go nowhere");
  wheel_to_body_ = pseudo_inverse(body_to_wheel_, ruled_out);
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
