#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "hal/types/geometry.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {

/// Row by row from the origin: x first, then y.
struct GridLayout {
  int columns = 1, rows = 1;
  hal::Vec2 spacing{};  ///< m, between neighbours.
  hal::Vec2 origin{};   ///< m, world frame.
  double yaw = 0;       ///< rad, of all.
};

/// Even angles, the first one east of the centre.
struct CircleLayout {
  int count = 1;
  double radius = 0;   ///< m
  hal::Vec2 centre{};  ///< m, world frame.
  double yaw = 0;      ///< rad, of all.
};

struct LineLayout {
  int count = 1;
  double spacing = 0;  ///< m, from one to the next.
  hal::Vec2 origin{};  ///< m, world frame.
  double heading = 0;  ///< rad, of the line.
  double yaw = 0;      ///< rad, of all.
};

/// Uniformly in a rectangle, each drawn anew until it is `spacing` away from all before it.
struct UniformLayout {
  int count = 1;
  hal::Vec2 from{}, to{};  ///< m, world frame.
  double spacing = 0;      ///< m, least distance of any two.
  double yaw = 0;          ///< rad, of all.
};

/// Where the agents of a group stand: their poses, or a layout.
using Placement =
    std::variant<std::vector<hal::Pose2>, GridLayout, CircleLayout, LineLayout, UniformLayout>;

/// The layouts, each a mapping under its name. None of them leaves the placement as it is, and what
/// `otherwise` describes is there. @return whether there is one.
bool layout_keys(Fields& io, Placement& placement, const std::function<void(Fields&)>& otherwise);

/// The name that files have for a layout; "poses" of poses.
std::string name_of(const Placement& placement);

/// What is wrong with a layout. No text: nothing.
struct LayoutMistake {
  std::string key;  ///< Empty: the layout as a whole.
  std::string text;
};

/// @param seed  of the run.   @param stream  name of the stream of random numbers.
std::vector<hal::Pose2> poses_of(const Placement& placement, std::uint64_t seed,
                                 const std::string& stream, LayoutMistake& mistake);

}  // namespace sim::scenario
