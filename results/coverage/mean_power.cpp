#include "results/coverage/mean_power.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <variant>

#include "hal/types/math.h"
#include "sim/agents/populated_world.h"

namespace results::coverage {
namespace {

constexpr hal::Dbm kNothing{-1000};

bool is_of_links(const sim::radio::PathLossConfig& law) {
  return std::holds_alternative<sim::radio::MeasuredConfig>(law);
}

/// Only the law of distance, down to any power.
void keep_means(sim::radio::WavesConfig& waves) {
  if (std::ranges::any_of(waves.propagation.chain, is_of_links)) {
    throw std::runtime_error(
        "radio.propagation: the model measured has losses of links, not of places");
  }
  std::erase_if(waves.propagation.chain,
                [](const auto& law) { return !sim::radio::is_law_of_distance(law); });
  waves.propagation.interference_floor = kNothing;
}

}  // namespace

MeanPower::MeanPower(const sim::agents::SimulationConfig& config) : config_(config) {
  sim::radio::WavesConfig* const waves = waves_of(config_.radio);
  if (waves == nullptr) {
    throw std::runtime_error(fmt::format("radio.profile: '{}' has a range and no power levels",
                                         sim::radio::profile_name(config_.radio)));
  }
  keep_means(*waves);
  config_.agents.clear();  // they are not in the way
  config_.movables.clear();
  world_ = sim::agents::populated_world(config_);
  obstacles_ = std::make_unique<sim::agents::WorldObstacles>(*world_, config_);
  propagation_ = std::make_unique<sim::radio::Propagation>(config_.radio, *obstacles_, ground());
}

MeanPower::~MeanPower() = default;

hal::Dbm MeanPower::Emission::towards(const hal::Vec3& place) const {
  if (directed == nullptr) return sent;
  return sent + hal::Decibels{10 * hal::math::log10(directed->towards(place - antenna))};
}

MeanPower::Emission MeanPower::emission_of(const sim::agents::AgentConfig& agent) const {
  const auto& air = waves().propagation;
  Emission emission;
  emission.sent = sim::radio::to_dbm(agent.radio.tx_power.value_or(waves().tx_power)) +
                  agent.radio.antenna_gain.value_or(air.antenna_gain) + air.antenna_gain;
  emission.antenna = sim::on(ground(), {agent.pose.x, agent.pose.y});
  emission.antenna.z += agent.radio.antenna_height.value_or(air.antenna_height).value;
  const sim::radio::AntennaConfig pattern = agent.radio.antenna.value_or(air.antenna);
  if (std::holds_alternative<sim::radio::OmniAntenna>(pattern)) return emission;
  const double half = agent.pose.theta / 2;
  const sim::radio::Attitude attitude{hal::math::cos(half), 0, 0, hal::math::sin(half)};
  emission.directed = std::make_shared<const sim::radio::DirectedAntenna>(
      sim::radio::AntennaPattern(pattern), attitude);
  return emission;
}

hal::Dbm MeanPower::received(const Emission& emission, const hal::Vec3& place) const {
  // Laws with rays from the ground need the height above it.
  const hal::Vec3& from = emission.antenna;
  const double ground_from = ground().height({from.x, from.y});
  const double ground_to = ground().height({place.x, place.y});
  const sim::radio::Site a({from.x, from.y, ground_from}, from.z - ground_from);
  const sim::radio::Site b({place.x, place.y, ground_to}, place.z - ground_to);
  const auto sent = sim::radio::to_milliwatts(emission.towards(place));
  const auto steady = propagation_->steady(sent, a, b);
  return sim::radio::to_dbm(steady.walls * steady.free);
}

}  // namespace results::coverage
