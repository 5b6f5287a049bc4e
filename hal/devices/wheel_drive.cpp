#include "hal/devices/wheel_drive.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hal/types/check.h"
#include "hal/types/math.h"

namespace hal::devices {
namespace {

using Row = std::array<double, 3>;

Row cross(const Row& a, const Row& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Row& a, const Row& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Row row_of(const Wheel& wheel) {
  const double dx = -math::sin(wheel.axle_heading);
  const double dy = math::cos(wheel.axle_heading);
  const double lever = dy * wheel.position.x - dx * wheel.position.y;
  return {dx / wheel.radius, dy / wheel.radius, lever / wheel.radius};
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

}  // namespace

WheelDrive::WheelDrive(const std::vector<Wheel>& wheels) {
  if (wheels.size() < 3)
    throw std::invalid_argument(fmt::format("wheels: {}, at least 3 allowed", wheels.size()));
  max_wheel_speed_ = wheels.front().max_speed;
  for (const Wheel& wheel : wheels) {
    if (!(wheel.radius > 0) || !(wheel.max_speed > 0))
      throw std::invalid_argument(
          fmt::format("wheels: radius {} m, max_speed {} rad/s: both must be positive",
                      wheel.radius, wheel.max_speed));
    max_wheel_speed_ = std::min(max_wheel_speed_, wheel.max_speed);
    body_to_wheel_.push_back(row_of(wheel));
  }
  const auto inverse = invert(gram(body_to_wheel_));
  for (const Row& row : body_to_wheel_)
    wheel_to_body_.push_back({dot(inverse[0], row), dot(inverse[1], row), dot(inverse[2], row)});
}

Twist2 WheelDrive::limits() const {
  Row largest{};
  for (const Row& row : body_to_wheel_)
    for (std::size_t i = 0; i < 3; ++i) largest[i] = std::max(largest[i], std::abs(row[i]));
  return {max_wheel_speed_ / largest[0], max_wheel_speed_ / largest[1],
          max_wheel_speed_ / largest[2]};
}

std::vector<double> WheelDrive::wheel_speeds(const Twist2& twist) const {
  std::vector<double> speeds(body_to_wheel_.size());
  wheel_speeds(twist, speeds);
  return speeds;
}

void WheelDrive::wheel_speeds(const Twist2& twist, std::span<double> speeds) const {
  BARAKA_CHECK(speeds.size() == body_to_wheel_.size());
  const Row body{twist.vx, twist.vy, twist.omega};
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

WheelDrive::Limited WheelDrive::saturate(const Twist2& twist) const {
  const Row body{twist.vx, twist.vy, twist.omega};
  double fastest = 0;
  for (const Row& row : body_to_wheel_) fastest = std::max(fastest, std::abs(dot(row, body)));
  if (fastest <= max_wheel_speed_) return {twist, false};
  const double factor = max_wheel_speed_ / fastest;
  return {{factor * twist.vx, factor * twist.vy, factor * twist.omega}, true};
}

}  // namespace hal::devices
