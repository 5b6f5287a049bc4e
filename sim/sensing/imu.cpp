#include "sim/sensing/imu.h"

#include <fmt/core.h>

#include <cmath>

#include "hal/types/math.h"
#include "hal/types/random.h"

namespace sim::sensing {
namespace {

using hal::Vec3;
using Quaternion = std::array<double, 4>;  // w, x, y, z

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// v + 2 w (u x v) + 2 u x (u x v) with the quaternion (w, u).
Vec3 rotated(const Vec3& v, const Quaternion& q) {
  const Vec3 u{q[1], q[2], q[3]};
  const Vec3 t = 2 * cross(u, v);
  return v + q[0] * t + cross(u, t);
}

Quaternion inverse(const Quaternion& q) { return {q[0], -q[1], -q[2], -q[3]}; }

/// The turn by q, then by a heading about the turned z axis.
Quaternion turned_on(const Quaternion& q, double heading) {
  const double c = hal::math::cos(heading / 2), s = hal::math::sin(heading / 2);
  return {q[0] * c - q[3] * s, q[1] * c + q[2] * s, q[2] * c - q[1] * s, q[3] * c + q[0] * s};
}

/// A vector turned about another one by its length, rad.
Vec3 turned_about(const Vec3& v, const Vec3& turn) {
  const double angle = std::sqrt(hal::dot(turn, turn));
  if (angle == 0) return v;
  const double s = hal::math::sin(angle / 2) / angle;
  return rotated(v, {hal::math::cos(angle / 2), s * turn.x, s * turn.y, s * turn.z});
}

class SimulatedImu final : public hal::node::devices::Sensor {
 public:
  SimulatedImu(const hal::node::devices::ImuSensor& imu, const SensorSite& site)
      : imu_(imu),
        site_(site),
        random_(site.run_seed, fmt::format("{}/{}", site.agent_name, imu.mount.name)) {}

  hal::Channel describe() const override { return imu_.describe(); }
  std::optional<std::vector<double>> sample(hal::Time at) override;

 private:
  hal::node::devices::ImuSensor imu_;
  SensorSite site_;
  hal::RandomStream random_;
  std::optional<Vec3> velocity_;  ///< Of its place at the reading before; none: not read yet.
  hal::Time read_at_{};           ///< As of which physics step.
};

std::optional<std::vector<double>> SimulatedImu::sample(hal::Time) {
  const physics::World& world = site_.world;
  if (velocity_ && world.now() == read_at_) return std::nullopt;
  const Quaternion body = world.pose(site_.agent).quaternion;
  const physics::BodyVelocity moving = world.velocity(site_.agent);
  const Vec3 velocity = moving.linear + cross(moving.angular, rotated(imu_.mount.position, body));
  const physics::WorldConfig& config = world.config();
  const InertialMotion motion{velocity_.value_or(velocity), velocity, moving.angular,
                              config.gravity * config.down,
                              velocity_ ? hal::to_seconds(world.now() - read_at_) : 1};
  velocity_ = velocity;
  read_at_ = world.now();
  const auto exact = inertial_values(motion, turned_on(body, imu_.mount.heading));
  std::vector<double> values(exact.begin(), exact.end());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double sigma = i < 3 ? imu_.gyro_sigma : imu_.accelerometer_sigma;
    if (sigma > 0) values[i] += sigma * random_.normal();
  }
  return values;
}

}  // namespace

std::array<double, 6> inertial_values(const InertialMotion& motion, const Quaternion& attitude) {
  const Quaternion to_sensor = inverse(attitude);
  const Vec3 rate = rotated(motion.angular, to_sensor);
  const Vec3 mean = (1 / motion.seconds) * (motion.velocity - motion.velocity_before);
  const Vec3 amid = turned_about(mean - motion.gravity, 0.5 * motion.seconds * motion.angular);
  const Vec3 force = rotated(amid, to_sensor);
  return {rate.x, rate.y, rate.z, force.x, force.y, force.z};
}

std::unique_ptr<hal::node::devices::Sensor> simulated(const hal::node::devices::ImuSensor& imu,
                                                      const SensorSite& site) {
  return std::make_unique<SimulatedImu>(imu, site);
}

}  // namespace sim::sensing
