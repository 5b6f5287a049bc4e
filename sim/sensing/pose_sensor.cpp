#include "sim/sensing/pose_sensor.h"

#include <fmt/core.h>

#include "hal/types/math.h"
#include "hal/types/random.h"

namespace sim::sensing {
namespace {

class SimulatedPose final : public hal::node::devices::Sensor {
 public:
  SimulatedPose(const hal::node::devices::PoseSensor& sensor, const SensorSite& site)
      : sensor_(sensor),
        site_(site),
        random_(site.run_seed, fmt::format("{}/{}", site.agent_name, sensor.mount.name)),
        instants_(sensor.period, random_.uniform()) {}

  hal::Channel describe() const override { return sensor_.describe(); }

  std::optional<std::vector<double>> sample(hal::Time at) override {
    const hal::Time instant = instants_.last(at);
    if (instant == measured_at_) return std::nullopt;
    measured_at_ = instant;
    const hal::Pose2 pose = pose_before(site_, at - instant);
    return std::vector{pose.x + noise(sensor_.position_sigma),
                       pose.y + noise(sensor_.position_sigma),
                       hal::math::wrap_angle(pose.theta + noise(sensor_.heading_sigma))};
  }

 private:
  double noise(double sigma) { return sigma > 0 ? sigma * random_.normal() : 0; }

  hal::node::devices::PoseSensor sensor_;
  SensorSite site_;
  hal::RandomStream random_;
  MeasuringInstants instants_;
  std::optional<hal::Time> measured_at_;
};

}  // namespace

std::unique_ptr<hal::node::devices::Sensor> simulated(const hal::node::devices::PoseSensor& sensor,
                                                      const SensorSite& site) {
  return std::make_unique<SimulatedPose>(sensor, site);
}

}  // namespace sim::sensing
