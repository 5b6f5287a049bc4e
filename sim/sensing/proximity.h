#pragma once

#include <memory>
#include <optional>

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "sim/physics/world.h"

namespace sim::sensing {

/// Horizontal sector: all points of a plane within a range and within an angle of a heading.
struct Sector {
  hal::Vec3 origin;       ///< m, world frame; z is the height of the plane
  double heading = 0;     ///< rad, of the middle
  double half_angle = 0;  ///< rad, 0 .. pi/2 exclusive
  double range = 0;       ///< m, > 0
};

/// Finds the nearest surface of a world's shapes in a sector: exact, without sampled rays.
class Proximity {
 public:
  /// @param world  outlives this; everything was added to it.
  explicit Proximity(const physics::World& world);
  ~Proximity();
  Proximity(const Proximity&) = delete;
  Proximity& operator=(const Proximity&) = delete;

  /// Follows the bodies. Call once per control tick, before the queries of that tick.
  void update();

  /// Distance [m] from the sector's origin to the nearest point of a shape in the sector, 0 inside
  /// a shape; none if the sector is empty. Shapes that the plane misses are not seen.
  /// @param own  shapes of this agent are transparent.
  std::optional<double> nearest(const Sector& sector, hal::AgentId own) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sim::sensing
