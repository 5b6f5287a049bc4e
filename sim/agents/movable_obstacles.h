#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hal/types/geometry.h"
#include "sim/core/cell_grid.h"
#include "sim/core/obstacle_loss.h"
#include "sim/physics/world.h"

namespace sim::agents {

/// Attenuation of radio by the movables of a world, wherever they are.
class MovableObstacles {
 public:
  /// @param world  outlives this object. @param movables  its movables, in their order.
  MovableObstacles(const physics::World& world, const std::vector<physics::Movable>& movables);

  /// Whether no movable attenuates.
  bool empty() const { return numbers_.empty(); }

  /// dB; sum over the movables that the segment crosses. One thread at a time.
  double loss(const hal::Vec3& from, const hal::Vec3& to) const;

 private:
  void follow() const;
  void put(std::uint32_t i) const;
  void collect(const hal::Vec3& from, const hal::Vec3& to) const;

  const physics::World& world_;
  std::vector<std::uint32_t> numbers_;               ///< Of those that attenuate.
  std::vector<std::optional<std::uint32_t>> index_;  ///< In numbers_, by number.
  std::vector<ObstacleLoss> losses_;                 ///< In the order of numbers_.
  double largest_ = 0;                               ///< m; radius of a ball around the largest
  mutable CellGrid grid_;
  mutable std::optional<std::uint64_t> followed_;  ///< Physics step of the grid.
  mutable std::vector<std::uint32_t> near_;
};

}  // namespace sim::agents
