#include "sim/sensing/scan.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "hal/types/random.h"
#include "sim/sensing/ray_fan.h"
#include "sim/sensing/sector_query.h"

namespace sim::sensing {
namespace {

using hal::node::devices::ScanSensor;

std::vector<double> headings_on_body(const ScanSensor& scan) {
  std::vector<double> headings = scan.headings();
  for (double& heading : headings) heading = scan.mount.heading + heading;
  return headings;
}

class SimulatedScan final : public hal::node::devices::Sensor {
 public:
  SimulatedScan(const ScanSensor& scan, const SensorSite& site)
      : scan_(scan),
        site_(site),
        random_(site.run_seed, fmt::format("{}/{}", site.agent_name, scan.mount.name)),
        instants_(scan.period, random_.uniform()),
        rays_(headings_on_body(scan), scan.max_range) {}

  hal::Channel describe() const override { return scan_.describe(); }
  std::optional<std::vector<double>> sample(hal::Time at) override;

 private:
  double reading(double metres);

  ScanSensor scan_;
  SensorSite site_;
  hal::RandomStream random_;
  MeasuringInstants instants_;
  RayFan rays_;
  std::optional<hal::Time> measured_at_;
};

std::optional<std::vector<double>> SimulatedScan::sample(hal::Time at) {
  const hal::Time instant = instants_.last(at);
  if (instant == measured_at_) return std::nullopt;
  measured_at_ = instant;
  const hal::Pose2 body = pose_before(site_, at - instant);
  const hal::Vec2 ahead = unit(body.theta);
  const hal::Vec2 offset = turned({scan_.mount.position.x, scan_.mount.position.y}, ahead);
  const hal::Vec3 origin{body.x + offset.x, body.y + offset.y,
                         site_.world.position(site_.agent).z + scan_.mount.position.z};
  std::vector<double> ranges =
      rays_.ranges(origin, ahead, site_.proximity(), site_.world.shapes(), site_.agent);
  for (double& range : ranges) range = reading(range);
  return ranges;
}

/// Reading of the scanner for a distance. m
double SimulatedScan::reading(double metres) {
  if (metres > scan_.max_range) return std::numeric_limits<double>::quiet_NaN();
  if (metres < scan_.min_range) return -std::numeric_limits<double>::infinity();
  const double told = metres + (scan_.noise_sigma > 0 ? scan_.noise_sigma * random_.normal() : 0);
  return std::clamp(told, scan_.min_range, scan_.max_range);
}

}  // namespace

std::vector<double> ray_ranges(const hal::Vec3& origin, std::span<const hal::Vec2> directions,
                               std::span<const physics::Shape> shapes,
                               std::span<const std::size_t> candidates, hal::AgentId own) {
  std::vector<double> ranges(directions.size(), std::numeric_limits<double>::infinity());
  for (const std::size_t index : candidates) {
    const physics::Shape& whole = shapes[index];
    if (whole.owner == own && own != hal::AgentId{}) continue;
    if (origin.z < whole.z_low || origin.z > whole.z_high) continue;
    const physics::Shape shape = slice(whole, origin.z);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const auto chord = inside(shape, {origin.x, origin.y}, directions[i]);
      if (chord && chord->to >= 0) ranges[i] = std::min(ranges[i], std::max(chord->from, 0.0));
    }
  }
  return ranges;
}

std::unique_ptr<hal::node::devices::Sensor> simulated(const ScanSensor& scan,
                                                      const SensorSite& site) {
  return std::make_unique<SimulatedScan>(scan, site);
}

}  // namespace sim::sensing
