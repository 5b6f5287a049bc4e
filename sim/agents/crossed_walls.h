#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/agents/simulation_config.h"
#include "sim/core/wall_crossings.h"
#include "sim/sensing/line_of_sight.h"

namespace sim::agents {

/// Counts the walls of each material that a path crosses, and the ceilings. A wall is what the path
/// passes of one material without leaving it for more than a gap, however many boxes it is made of.
class CrossedWalls {
 public:
  explicit CrossedWalls(const SimulationConfig& config);

  /// Those of the walls, each once, in the order of WallCrossings::walls.
  const std::vector<Material>& materials() const { return materials_; }

  /// @param parts  boxes on the path, in any order.
  void count(std::span<const sensing::LineOfSight::Wall> parts, hal::Metres gap,
             WallCrossings& crossed) const;

  /// Ceilings between two heights [m]; an antenna at the height of a ceiling is not beyond it.
  void count_ceilings(double from, double to, WallCrossings& crossed) const;

 private:
  struct Part {
    std::uint32_t material;
    double begin, end;  ///< m from the path's start
  };

  std::vector<Material> materials_;
  std::vector<std::uint32_t> by_wall_;  ///< Index of its material.
  std::vector<Ceiling> ceilings_;
  mutable std::vector<Part> parts_;
};

}  // namespace sim::agents
