#include "sim/sensing/imu.h"

#include <fmt/core.h>
#include <Eigen/Geometry>

#include <cmath>

#include "hal/types/math.h"
#include "hal/types/random.h"

namespace sim::sensing {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using hal::Vec3;

Vector3d in_eigen(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 from_eigen(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Quaterniond in_eigen(const std::array<double, 4>& q) { return {q[0], q[1], q[2], q[3]}; }

/// Rotation about the z axis by a heading. This and the next function avoid Eigen's AngleAxis,
/// which would use the C library's sine and cosine.
Quaterniond turned_by(double heading) {
  return {hal::math::cos(heading / 2), 0, 0, hal::math::sin(heading / 2)};
}

/// Rotation about a vector by its length. rad
Quaterniond turned_about(const Vector3d& turn) {
  const double angle = turn.norm();
  if (angle == 0) return Quaterniond::Identity();
  const double s = hal::math::sin(angle / 2) / angle;
  return {hal::math::cos(angle / 2), s * turn.x(), s * turn.y(), s * turn.z()};
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
  /// Velocity of the sensor at the previous reading; nullopt: not read yet.
  std::optional<Vec3> velocity_;
  hal::Time read_at_{};  ///< Physics step of that reading.
};

std::optional<std::vector<double>> SimulatedImu::sample(hal::Time) {
  const physics::World& world = site_.world;
  if (velocity_ && world.now() == read_at_) return std::nullopt;
  const Quaterniond body = in_eigen(world.pose(site_.agent).quaternion);
  const physics::BodyVelocity moving = world.velocity(site_.agent);
  const Vector3d arm = body * in_eigen(imu_.mount.position);
  const Vec3 velocity = moving.linear + from_eigen(in_eigen(moving.angular).cross(arm));
  const physics::WorldConfig& config = world.config();
  const InertialMotion motion{velocity_.value_or(velocity), velocity, moving.angular,
                              config.gravity * config.down,
                              velocity_ ? hal::to_seconds(world.now() - read_at_) : 1};
  velocity_ = velocity;
  read_at_ = world.now();
  const Quaterniond sensor = body * turned_by(imu_.mount.heading);
  const auto exact = inertial_values(motion, {sensor.w(), sensor.x(), sensor.y(), sensor.z()});
  std::vector<double> values(exact.begin(), exact.end());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double sigma = i < 3 ? imu_.gyro_sigma : imu_.accelerometer_sigma;
    if (sigma > 0) values[i] += sigma * random_.normal();
  }
  return values;
}

}  // namespace

std::array<double, 6> inertial_values(const InertialMotion& motion,
                                      const std::array<double, 4>& attitude) {
  const Quaterniond to_sensor = in_eigen(attitude).conjugate();
  const Vector3d angular = in_eigen(motion.angular);
  const Vec3 mean = (1 / motion.seconds) * (motion.velocity - motion.velocity_before);
  const Vector3d amid =
      turned_about(0.5 * motion.seconds * angular) * in_eigen(mean - motion.gravity);
  const Vector3d rate = to_sensor * angular, force = to_sensor * amid;
  return {rate.x(), rate.y(), rate.z(), force.x(), force.y(), force.z()};
}

std::unique_ptr<hal::node::devices::Sensor> simulated(const hal::node::devices::ImuSensor& imu,
                                                      const SensorSite& site) {
  return std::make_unique<SimulatedImu>(imu, site);
}

}  // namespace sim::sensing
