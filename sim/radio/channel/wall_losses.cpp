#include "sim/radio/channel/wall_losses.h"

#include <algorithm>

#include "hal/types/math.h"
#include "sim/radio/channel/channel_number.h"

namespace sim::radio {

double ceiling_factor(std::uint32_t ceilings, double b) {
  const double k = ceilings;
  return ceilings == 0 ? 0 : hal::math::pow(k, (k + 2) / (k + 1) - b);
}

WallLosses::WallLosses(const MultiWallConfig& config, const Obstacles& world, std::uint32_t channel)
    : config_(config), world_(world) {
  for (const Material& material : world.materials()) {
    const auto own =
        std::ranges::find(config.walls, material.name, &MultiWallConfig::WallLoss::material);
    const hal::Decibels loss = is_5ghz(channel) ? material.loss_5ghz : material.loss;
    by_material_.push_back(own == config.walls.end() ? loss.value : own->loss.value);
  }
}

hal::Decibels WallLosses::loss(const WallCrossings& crossed) const {
  double sum = 0;
  for (std::size_t m = 0; m < crossed.walls.size(); ++m) sum += crossed.walls[m] * by_material_[m];
  if (crossed.ceilings > 0) {
    const double mean = crossed.ceiling_loss.value / crossed.ceilings;
    const double one = config_.ceiling_loss ? config_.ceiling_loss->value : mean;
    sum += ceiling_factor(crossed.ceilings, config_.ceiling_b) * one;
  }
  return hal::Decibels{sum};
}

hal::Decibels WallLosses::loss(const hal::Vec3& from, const hal::Vec3& to) const {
  world_.crossings(from, to, config_.gap, crossed_);
  return loss(crossed_);
}

}  // namespace sim::radio
