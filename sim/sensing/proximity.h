#pragma once

#include <memory>
#include <optional>
#include <span>

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "sim/physics/world.h"
#include "sim/sensing/sector_query.h"

namespace sim::physics {
class WallTree;
}

namespace sim::sensing {

/// Finds the nearest surface of a world's shapes in a sector: exact, without sampled rays.
class Proximity {
 public:
  /// @param world  outlives this object; everything has been added to it.
  explicit Proximity(const physics::World& world);
  ~Proximity();
  Proximity(const Proximity&) = delete;
  Proximity& operator=(const Proximity&) = delete;

  /// Updates the positions of bodies. Call before queries, whenever the world has advanced. Called
  /// after every step, its cost is proportional to the number of moved bodies.
  void update();

  /// Distance [m] from the sector's origin to the nearest point of a shape in the sector; 0 inside
  /// a shape; nullopt if the sector is empty. Shapes that do not intersect the sector's plane are
  /// not detected.
  /// @param own  shapes of this agent are transparent. One thread at a time.
  std::optional<double> nearest(const SectorQuery& sector, hal::AgentId own) const {
    return nearest(sector, own, within(sector.bounds()));
  }
  std::optional<double> nearest(const Sector& sector, hal::AgentId own) const {
    return nearest(SectorQuery(sector), own);
  }

  /// Shapes of the world that may reach into a region, in ascending order: one search for several
  /// sectors. Valid until the next search.
  std::span<const std::size_t> within(const Region& region) const;

  /// The same without what never moves.
  std::span<const std::size_t> moving_within(const Region& region) const;

  /// All that never moves, for searches along rays; empty if that is little. Its members are
  /// indices in walls().
  const physics::WallTree& wall_tree() const;
  std::span<const physics::Shape> walls() const;

  /// The same with the shapes already searched. @param candidates  from within() for a region that
  /// contains the sector.
  std::optional<double> nearest(const SectorQuery& sector, hal::AgentId own,
                                std::span<const std::size_t> candidates) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sim::sensing
