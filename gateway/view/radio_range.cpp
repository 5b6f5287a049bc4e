#include "gateway/view/radio_range.h"

#include <cmath>
#include <limits>
#include <variant>

#include "sim/radio/propagation.h"

namespace gateway::view {
namespace {

namespace radio = sim::radio;

struct NoObstacles final : radio::Obstacles {
  hal::Decibels loss(const hal::Vec3&, const hal::Vec3&) const override { return {}; }
};

/// Of the profiles whose range is one of their settings.
double range_setting(const radio::RadioConfig& config) {
  if (const auto* ideal = std::get_if<radio::IdealConfig>(&config)) return ideal->range.value;
  return std::get<radio::DiskConfig>(config).range.value;
}

}  // namespace

std::optional<double> radio_range(const sim::agents::SimulationConfig& config,
                                  const sim::agents::AgentConfig& agent) {
  double range = 0;
  if (const radio::WavesConfig* const waves = radio::waves_of(config.radio)) {
    const NoObstacles none;
    const hal::Milliwatts sent = agent.radio.tx_power.value_or(waves->tx_power);
    range = radio::Propagation(config.radio, none)
                .reach(sent, radio::to_milliwatts(waves->receiver.sensitivity));
  } else {
    range = range_setting(config.radio);
  }
  return std::isfinite(range) ? std::optional(range) : std::nullopt;
}

std::vector<std::pair<std::int64_t, std::int64_t>> links_at_start(
    const sim::agents::SimulationConfig& config) {
  const auto range_of = [&](const auto& agent) {
    return radio_range(config, agent).value_or(std::numeric_limits<double>::infinity());
  };
  std::vector<double> ranges;
  ranges.reserve(config.agents.size());
  for (const auto& agent : config.agents) ranges.push_back(range_of(agent));
  std::vector<std::pair<std::int64_t, std::int64_t>> links;
  for (std::size_t b = 0; b < ranges.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const hal::Pose2 &from = config.agents[a].pose, &to = config.agents[b].pose;
      const double distance = std::hypot(to.x - from.x, to.y - from.y);
      if (distance > std::min(ranges[a], ranges[b])) continue;
      links.emplace_back(config.agents[a].id.value, config.agents[b].id.value);
    }
  }
  return links;
}

}  // namespace gateway::view
