#include "sim/sensing/sonar.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "hal/types/random.h"
#include "sim/sensing/cone_query.h"

namespace sim::sensing {
namespace {

class SimulatedSonar final : public hal::node::devices::Sensor {
 public:
  SimulatedSonar(const hal::node::devices::Sonar& sonar, const SensorSite& site)
      : sonar_(sonar),
        site_(site),
        random_(site.run_seed, fmt::format("{}/{}", site.agent_name, sonar.mount.name)),
        instants_(sonar.period, random_.uniform()),
        middle_(unit(sonar.mount.heading)),
        half_angle_(unit(sonar.half_angle)) {}

  hal::Channel describe() const override { return sonar_.describe(); }
  std::optional<std::vector<double>> sample(hal::Time at) override;

 private:
  Cone cone_at(const hal::Pose2& body) const;
  double range_in(const Cone& cone) const;

  hal::node::devices::Sonar sonar_;
  SensorSite site_;
  hal::RandomStream random_;
  MeasuringInstants instants_;
  hal::Vec2 middle_;      ///< Unit vector, body frame.
  hal::Vec2 half_angle_;  ///< Cosine and sine.
  std::optional<hal::Time> measured_at_;
};

std::optional<std::vector<double>> SimulatedSonar::sample(hal::Time at) {
  const hal::Time instant = instants_.last(at);
  if (instant == measured_at_) return std::nullopt;
  measured_at_ = instant;
  const double metres = range_in(cone_at(pose_before(site_, at - instant)));
  const double noise = sonar_.noise_sigma > 0 ? sonar_.noise_sigma * random_.normal() : 0;
  return std::vector{sonar_.reading(metres, noise)};
}

Cone SimulatedSonar::cone_at(const hal::Pose2& body) const {
  const hal::Vec2 ahead = unit(body.theta);
  const hal::Vec3& place = sonar_.mount.position;
  const hal::Vec2 offset = turned({place.x, place.y}, ahead);
  return {
      .apex = {body.x + offset.x, body.y + offset.y, site_.world.position(site_.agent).z + place.z},
      .axis = turned(middle_, ahead),
      .half_angle = half_angle_,
      .range = sonar_.max_range};
}

/// Distance in the cone, m; infinity if nothing is within range.
double SimulatedSonar::range_in(const Cone& cone) const {
  double range = std::numeric_limits<double>::infinity();
  const auto shapes = site_.world.shapes();
  for (const std::size_t index : site_.proximity().within(bounds(cone))) {
    const physics::Shape& shape = shapes[index];
    if (shape.owner == site_.agent) continue;
    range = std::min(range, nearest(cone, shape).value_or(range));
  }
  return range;
}

}  // namespace

std::unique_ptr<hal::node::devices::Sensor> simulated(const hal::node::devices::Sonar& sonar,
                                                      const SensorSite& site) {
  return std::make_unique<SimulatedSonar>(sonar, site);
}

}  // namespace sim::sensing
