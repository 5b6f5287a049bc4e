#include "results/coverage/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "hal/types/math.h"
#include "hal/types/pattern.h"
#include "results/coverage/mean_power.h"
#include "results/coverage/usable_rate.h"
#include "sim/radio/station_profile.h"

namespace results::coverage {
namespace {

using sim::agents::AgentConfig;
using sim::agents::SimulationConfig;

constexpr double kMargin = 1;  // m

/// A transmitter with what its powers and rates follow from.
struct Source {
  Transmitter transmitter;
  MeanPower::Emission emission;
  UsableRate rates;
};

void extend(Area& area, hal::Vec2 point) {
  area.low = {std::min(area.low.x, point.x), std::min(area.low.y, point.y)};
  area.high = {std::max(area.high.x, point.x), std::max(area.high.y, point.y)};
}

std::vector<hal::AgentId> transmitters_of(const SimulationConfig& config, const std::string& of) {
  if (of.empty()) return access_points_of(config);
  std::vector<hal::AgentId> found;
  for (const AgentConfig& agent : config.agents)
    if (hal::matches(of, agent.name)) found.push_back(agent.id);
  return found;
}

std::vector<Source> sources_of(const SimulationConfig& config, const CoverageOptions& options,
                               const MeanPower& power) {
  const auto wanted = transmitters_of(config, options.of);
  if (wanted.empty()) {
    throw std::runtime_error(
        options.of.empty() ? "there is no access point (radio.bss.access_point); --of PATTERN "
                             "names other agents whose coverage is computed"
                           : fmt::format("--of: '{}' matches no agent", options.of));
  }
  std::vector<Source> sources;
  for (const AgentConfig& agent : config.agents) {
    if (std::ranges::find(wanted, agent.id) == wanted.end()) continue;
    const auto radio = sim::radio::config_for(config.radio, agent.radio, false);
    const MeanPower::Emission emission = power.emission_of(agent);
    sources.push_back({{agent.name, emission.antenna}, emission, UsableRate(radio, options.bytes)});
  }
  return sources;
}

std::vector<double> rates_of(const std::vector<Source>& sources) {
  std::set<double> rates;
  for (const Source& source : sources)
    for (const auto& step : source.rates.steps()) rates.insert(step.rate.value / 1e6);
  return {rates.begin(), rates.end()};
}

/// Sets the grid. @throws std::runtime_error
void divide(Coverage& map, double step) {
  const hal::Vec2 size = map.area.high - map.area.low;
  const double columns = std::max(1.0, std::ceil(size.x / step - 1e-9));
  const double rows = std::max(1.0, std::ceil(size.y / step - 1e-9));
  if (columns * rows * static_cast<double>(map.transmitters.size()) > kMostPoints) {
    throw std::runtime_error(
        fmt::format("{:g} x {:g} points for {} agents are too many: choose a greater --step or an "
                    "--area",
                    columns, rows, map.transmitters.size()));
  }
  map.step = step;
  map.columns = static_cast<std::size_t>(columns);
  map.rows = static_cast<std::size_t>(rows);
}

Spot spot_at(const std::vector<Source>& sources, const MeanPower& power, const hal::Vec3& place,
             std::vector<double>& rssi) {
  Spot spot;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Source& source = sources[i];
    const hal::Dbm level = power.received(source.emission, place);
    rssi.push_back(level.value);
    if (i == 0 || level > spot.rssi) spot = {.best = i, .rssi = level};
  }
  spot.snr = spot.rssi - power.waves().receiver.noise_floor;
  spot.rate = sources[spot.best].rates.at(spot.rssi);
  return spot;
}

}  // namespace

Area area_around(const SimulationConfig& config) {
  const hal::Pose2& first = config.agents.front().pose;
  Area area{{first.x, first.y}, {first.x, first.y}};
  for (const AgentConfig& agent : config.agents) extend(area, {agent.pose.x, agent.pose.y});
  for (const auto& wall : config.walls) {
    const double c = hal::math::cos(wall.yaw), s = hal::math::sin(wall.yaw);
    for (const double x : {-wall.size.x / 2, wall.size.x / 2}) {
      for (const double y : {-wall.size.y / 2, wall.size.y / 2})
        extend(area, {wall.centre.x + c * x - s * y, wall.centre.y + s * x + c * y});
    }
  }
  const hal::Vec2 margin{kMargin, kMargin};
  return {area.low - margin, area.high + margin};
}

std::vector<hal::AgentId> access_points_of(const SimulationConfig& config) {
  std::set<std::string> names;
  if (const auto* const dcf = dcf_of(config.radio))
    names.insert(dcf->bss.access_points.begin(), dcf->bss.access_points.end());
  for (const AgentConfig& agent : config.agents) {
    if (!agent.radio.access_points) continue;
    names.insert(agent.radio.access_points->begin(), agent.radio.access_points->end());
  }
  std::vector<hal::AgentId> found;
  for (const AgentConfig& agent : config.agents)
    if (names.contains(agent.name)) found.push_back(agent.id);
  return found;
}

Coverage coverage_of(const SimulationConfig& config, const CoverageOptions& options) {
  const MeanPower power(config);
  const std::vector<Source> sources = sources_of(config, options, power);
  const auto& waves = power.waves();
  Coverage map;
  map.area = options.area.value_or(area_around(config));
  map.height = options.at.value_or(waves.propagation.antenna_height).value;
  map.sensitivity = waves.receiver.sensitivity;
  map.bytes = options.bytes;
  map.rates = rates_of(sources);
  for (const Source& source : sources) map.transmitters.push_back(source.transmitter);
  divide(map, options.step.value);
  map.spots.reserve(map.columns * map.rows);
  for (std::size_t row = 0; row < map.rows; ++row) {
    for (std::size_t column = 0; column < map.columns; ++column) {
      hal::Vec3 place = sim::on(power.ground(), map.centre(column, row));
      place.z += map.height;
      map.spots.push_back(spot_at(sources, power, place, map.rssi));
    }
  }
  return map;
}

}  // namespace results::coverage
