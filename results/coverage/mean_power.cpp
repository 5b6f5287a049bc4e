#include "results/coverage/mean_power.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "sim/agents/populated_world.h"

namespace results::coverage {
namespace {

constexpr hal::Dbm kNothing{-1000};

/// Only the law of distance, down to any power.
void keep_means(sim::radio::WavesConfig& waves) {
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
  config_.agents.clear();  // their bodies are not in the way
  world_ = sim::agents::populated_world(config_);
  obstacles_ = std::make_unique<sim::agents::WorldObstacles>(*world_, config_);
  propagation_ = std::make_unique<sim::radio::Propagation>(config_.radio, *obstacles_, ground());
}

MeanPower::~MeanPower() = default;

hal::Dbm MeanPower::sent_by(const sim::agents::AgentConfig& agent) const {
  const hal::Decibels usual = waves().propagation.antenna_gain;
  const hal::Decibels own = agent.radio.antenna_gain.value_or(usual);
  return sim::radio::to_dbm(agent.radio.tx_power.value_or(waves().tx_power)) + own + usual;
}

hal::Vec3 MeanPower::antenna_of(const sim::agents::AgentConfig& agent) const {
  hal::Vec3 place = sim::on(ground(), {agent.pose.x, agent.pose.y});
  place.z += agent.radio.antenna_height.value_or(waves().propagation.antenna_height).value;
  return place;
}

hal::Dbm MeanPower::received(hal::Dbm sent, const hal::Vec3& from, const hal::Vec3& to) const {
  // Laws with rays from the ground need the height above it.
  const double ground_from = ground().height({from.x, from.y});
  const double ground_to = ground().height({to.x, to.y});
  const sim::radio::Site a({from.x, from.y, ground_from}, from.z - ground_from);
  const sim::radio::Site b({to.x, to.y, ground_to}, to.z - ground_to);
  const auto steady = propagation_->steady(sim::radio::to_milliwatts(sent), a, b);
  return sim::radio::to_dbm(steady.walls * steady.free);
}

}  // namespace results::coverage
