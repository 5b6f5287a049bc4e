#pragma once

#include <cstdint>
#include <vector>

#include "sim/core/wall_crossings.h"
#include "sim/radio/channel/multi_wall.h"
#include "sim/radio/channel/ports.h"

namespace sim::radio {

/// The walls and ceilings of the multi-wall law (multi_wall.h).
class WallLosses final : public Obstacles {
 public:
  /// @param world  outlives this; has all its walls.
  /// @param channel  its band selects the losses of the materials.
  WallLosses(const MultiWallConfig& config, const Obstacles& world, std::uint32_t channel);

  hal::Decibels loss(const hal::Vec3& from, const hal::Vec3& to) const override;

  /// By what `crossed` are weakened.
  hal::Decibels loss(const WallCrossings& crossed) const;

 private:
  MultiWallConfig config_;
  const Obstacles& world_;
  std::vector<double> by_material_;  ///< dB
  mutable WallCrossings crossed_;
};

/// k^((k + 2) / (k + 1) - b): how many times the loss of one ceiling `ceilings` of them have.
double ceiling_factor(std::uint32_t ceilings, double b);

}  // namespace sim::radio
