#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "sim/physics/shape.h"
#include "sim/sensing/proximity.h"

namespace sim::sensing {

/// Rays with fixed headings on a body, as of a laser scanner. Finds the rays that may meet a shape
/// by the angle under which it is seen; of many walls, those behind what was found already are not
/// looked at.
class RayFan {
 public:
  /// @param headings  rad, in the body's frame, in any order
  /// @param reach  m; ranges beyond it may be too large.
  RayFan(const std::vector<double>& headings, double reach);

  /// The same as ray_ranges(), to the last bit, with the fan's rays turned to `ahead`.
  /// @param origin  m, world frame. @param ahead  unit vector of the body's x axis, world frame.
  /// @param own  shapes of this agent are transparent. Not by two threads at a time.
  std::vector<double> ranges(const hal::Vec3& origin, hal::Vec2 ahead, const Proximity& proximity,
                             std::span<const physics::Shape> shapes, hal::AgentId own);

 private:
  /// An upright box, or one around a shape, seen from above. m
  struct Block {
    hal::Vec2 centre, axis, half;
  };
  static Block block_around(const physics::Shape& shape);

  /// First and behind-last rays; those of the second part come before x.
  using Part = std::pair<std::size_t, std::size_t>;
  using Parts = std::array<Part, 2>;
  Parts rays_to(const Block& block) const;

  void test(const physics::Shape& shape);
  void test_walls(const Proximity& proximity);
  bool is_hidden(const Block& block, double distance) const;

  // Of the rays in the order of their angles in the body's frame:
  std::vector<double> numbers_;        ///< Grow with the angles.
  std::vector<hal::Vec2> rays_;        ///< Unit vectors, body frame.
  std::vector<hal::Vec2> directions_;  ///< The same in the world frame, for the last search.
  std::vector<double> found_;          ///< Ranges of the last search, m.
  std::vector<std::size_t> places_;    ///< Places among the headings.

  double reach_;      ///< m
  hal::Vec3 origin_;  ///< Of the last search.
  hal::Vec2 ahead_{1, 0};
};

}  // namespace sim::sensing
