#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "hal/types/geometry.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {

/// Row by row from the origin: first along x, then along y.
struct GridLayout {
  int columns = 1, rows = 1;
  hal::Vec2 spacing{};  ///< m, between neighbours
  hal::Vec2 origin{};   ///< m, world frame
  double yaw = 0;       ///< rad, of all agents
};

/// Evenly spaced on a circle, the first east of the centre.
struct CircleLayout {
  int count = 1;
  double radius = 0;   ///< m
  hal::Vec2 centre{};  ///< m, world frame
  double yaw = 0;      ///< rad, of all agents
};

struct LineLayout {
  int count = 1;
  double spacing = 0;  ///< m, between neighbours
  hal::Vec2 origin{};  ///< m, world frame
  double heading = 0;  ///< rad, of the line
  double yaw = 0;      ///< rad, of all agents
};

/// Uniformly distributed in a rectangle; each point is drawn again until it is `spacing` away from
/// all previous ones.
struct UniformLayout {
  int count = 1;
  hal::Vec2 from{}, to{};  ///< m, world frame
  double spacing = 0;      ///< m, minimum distance of any two
  double yaw = 0;          ///< rad, of all agents
};

/// Placement of the agents of a group: their poses, or a layout.
using Placement =
    std::variant<std::vector<hal::Pose2>, GridLayout, CircleLayout, LineLayout, UniformLayout>;

/// The keys of the layouts, each a mapping under its name. Without any of them the placement stays
/// unchanged and the keys that `otherwise` describes apply. @return whether a layout is given.
bool layout_keys(Fields& io, Placement& placement, const std::function<void(Fields&)>& otherwise);

/// Name of a layout in scenario files; "poses" for poses.
std::string name_of(const Placement& placement);

/// A mistake in a layout; an empty text means that there is none.
struct LayoutMistake {
  std::string key;  ///< Empty: the whole layout.
  std::string text;
};

/// The poses of a placement. @param seed  of the run. @param stream  name of the random stream.
std::vector<hal::Pose2> poses_of(const Placement& placement, std::uint64_t seed,
                                 const std::string& stream, LayoutMistake& mistake);

}  // namespace sim::scenario
