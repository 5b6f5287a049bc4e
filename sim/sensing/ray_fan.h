#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "sim/physics/shape.h"

namespace sim::sensing {

/// Rays with fixed headings on a body, as of a laser scanner. Finds the rays that may meet a shape
/// by the angle under which it is seen, so that a search takes time for the shapes and the rays
/// that meet them, not for all pairs.
class RayFan {
 public:
  /// @param headings  rad, in the body's frame, in any order
  explicit RayFan(const std::vector<double>& headings);

  /// The same as ray_ranges(), to the last bit, with the fan's rays turned to `ahead`.
  /// @param origin  m, world frame. @param ahead  unit vector of the body's x axis, world frame.
  /// @param own  shapes of this agent are transparent. Not by two threads at a time.
  std::vector<double> ranges(const hal::Vec3& origin, hal::Vec2 ahead,
                             std::span<const physics::Shape> shapes,
                             std::span<const std::size_t> candidates, hal::AgentId own);

 private:
  /// Angles as numbers that grow with them, 0 .. kTurn: no trigonometry is needed.
  static constexpr double kTurn = 4;
  static double number_of(hal::Vec2 direction);

  struct Seen {
    double from = 0,
           to = kTurn;  ///< In numbers of angles, counter-clockwise; `to` may be above a turn.
  };
  Seen seen(const physics::Shape& shape, hal::Vec2 origin) const;
  void test(const physics::Shape& shape, hal::Vec2 origin, std::vector<double>& ranges) const;

  std::vector<hal::Vec2> rays_;          ///< Unit vectors, body frame.
  std::vector<hal::Vec2> directions_;    ///< The same in the world frame, for the last search.
  std::vector<double> numbers_;          ///< Of the rays' angles in the body's frame, ascending.
  std::vector<std::uint32_t> in_order_;  ///< Rays in that order.
  hal::Vec2 ahead_{1, 0};
};

}  // namespace sim::sensing
