#include "view/server/radio_range.h"

#include <cmath>
#include <limits>
#include <variant>

#include "sim/radio/channel/propagation.h"

namespace view::server {
namespace {

namespace radio = sim::radio;

struct NoObstacles final : radio::Obstacles {
  hal::Decibels loss(const hal::Vec3&, const hal::Vec3&) const override { return {}; }
};

}  // namespace

std::optional<double> radio_range(const sim::agents::SimulationConfig& config,
                                  const sim::agents::AgentConfig& agent) {
  const double range = std::visit(
      [&](const auto& profile) {
        if constexpr (requires { profile.range; }) {
          return profile.range.value;
        } else {
          const NoObstacles none;
          const hal::Milliwatts sent = agent.radio.tx_power.value_or(profile.tx_power);
          return radio::Propagation(config.radio, none)
              .reach(sent, radio::to_milliwatts(profile.receiver.sensitivity));
        }
      },
      config.radio);
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

}  // namespace view::server
