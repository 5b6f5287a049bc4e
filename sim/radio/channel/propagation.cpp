#include "sim/radio/channel/propagation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "hal/types/math.h"
#include "sim/radio/channel/path_losses.h"
#include "sim/radio/channel/power_law.h"

namespace sim::radio {
namespace {

constexpr hal::Milliwatts kAnyPower{1e-300};

/// What is left of a power, as a share.
double share(hal::Decibels loss) { return hal::math::pow(10, -loss.value / 10); }

}  // namespace

hal::Dbm to_dbm(hal::Milliwatts power) { return hal::Dbm{10 * hal::math::log10(power.value)}; }

hal::Milliwatts to_milliwatts(hal::Dbm level) {
  return hal::Milliwatts{hal::math::pow(10, level.value / 10)};
}

Propagation::Propagation(const RadioConfig& config, const Obstacles& obstacles,
                         const Ground& ground) {
  std::visit(
      [&](const auto& one) {
        if constexpr (requires { one.range; })
          add(one.range);
        else
          add(one, obstacles, ground);
      },
      config);
}

void Propagation::add(const WavesConfig& config, const Obstacles& obstacles, const Ground& ground) {
  const PropagationConfig& air = config.propagation;
  for (const PathLossConfig& one : air.chain) add(path_loss(one, air, ground));
  if (air.obstacles) obstacles_ = &obstacles;
  if (air.obstacles && (!air.body_loss.is_none() || obstacles.has_movables()))
    moving_obstacles_ = &obstacles;
  delays_ = air.propagation_delay;
  sensitivity_ = to_milliwatts(config.receiver.sensitivity);
  floor_ = to_milliwatts(air.interference_floor);
  audible_ = to_milliwatts(std::min(config.receiver.sensitivity, config.receiver.cca_threshold));
}

void Propagation::add(hal::Metres range) {
  add(std::make_unique<Cutoff>(range));
  sensitivity_ = floor_ = audible_ = kAnyPower;
}

void Propagation::add(std::unique_ptr<const PathLoss> loss) {
  const bool in_time = loss->changes_in_time();
  most_gain_ *= loss->most_gain();
  if (in_time) most_in_time_ *= loss->most_gain();
  (in_time ? in_time_ : chain_).push_back(std::move(loss));
}

double Propagation::reach(hal::Milliwatts sent, hal::Milliwatts least) const {
  const hal::Milliwatts most = most_gain_ * sent;
  double reach = std::numeric_limits<double>::infinity();
  for (const auto& loss : chain_) reach = std::min(reach, loss->reach(most, least));
  return reach;
}

Propagation::Strength Propagation::strength(const Steady& steady) const {
  const hal::Milliwatts free = most_in_time_ * steady.free;
  const hal::Milliwatts left = steady.walls * free;
  if (is_blocked(free, left) || left >= audible_) return Strength::kAudible;
  return left >= floor_ ? Strength::kFaint : Strength::kNothing;
}

Propagation::Steady Propagation::steady(hal::Milliwatts sent, const Site& from,
                                        const Site& to) const {
  const Path path(from, to);
  Steady result{.free = sent, .distance_squared = path.distance_squared};
  for (const auto& loss : chain_) result.free = loss->after(result.free, path);
  if (obstacles_ != nullptr && most_in_time_ * result.free >= floor_) {
    const hal::Decibels loss = obstacles_->loss(from.antenna(), to.antenna());
    if (loss.value > 0) result.walls = share(loss);
  }
  result.strength = strength(result);
  return result;
}

Propagation::Steady Propagation::steady_at(hal::Milliwatts sent, double distance) const {
  return steady(sent, Site(hal::Vec3{}), Site(hal::Vec3{distance, 0, 0}));
}

Propagation::Arrival Propagation::arrival(const Steady& steady, const Site& from, const Site& to,
                                          hal::Time at) const {
  if (steady.strength != Strength::kAudible) return mean_arrival(steady);
  const Path path(from, to, at);
  hal::Milliwatts free = steady.free;
  double left = steady.walls;
  for (const auto& loss : in_time_) free = loss->after(free, path);
  if (moving_obstacles_ != nullptr) {
    left *= share(
        moving_obstacles_->moving_loss({from.agent, from.antenna()}, {to.agent, to.antenna()}));
  }
  Arrival result{.power = left * free, .strength = steady.strength};
  result.blocked = is_blocked(free, result.power);
  result.level = to_dbm(result.power);
  if (result.power < floor_) result.power = {};
  result.delay = delay(steady.distance_squared);
  return result;
}

Propagation::Arrival Propagation::mean_arrival(const Steady& steady) const {
  Arrival result{.power = steady.walls * steady.free, .strength = steady.strength};
  result.blocked = is_blocked(steady.free, result.power);
  if (result.power < floor_) result.power = {};
  result.delay = delay(steady.distance_squared);
  return result;
}

}  // namespace sim::radio
