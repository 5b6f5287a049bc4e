#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/types/geometry.h"

namespace hal {

/// A shape that viewers draw, upright, in the frame of what it belongs to.
struct Solid {
  /// Numbers as in visualization_msgs/Marker.
  enum class Shape : std::uint8_t { kArrow = 0, kBox = 1, kSphere = 2, kCylinder = 3 };

  Shape shape = Shape::kBox;
  Vec3 size;       ///< m along its own axes; of an arrow: length, width, height
  Vec3 centre;     ///< m; of an arrow: where it begins
  double yaw = 0;  ///< rad, of its own x axis
  bool operator==(const Solid&) const = default;
};

/// Middle of a solid in the world [m]. @param frame  pose of the frame that it is fixed in
Vec3 centre_in_world(const Solid& solid, const Pose2& frame);

/// What a group of solids is, for its colour.
enum class DrawnAs : std::uint8_t { kWall, kMote, kRobot, kStation };

/// Solids with a name: a wall, or the body of an agent.
struct DrawnBody {
  std::string name;
  DrawnAs kind = DrawnAs::kWall;
  std::vector<Solid> solids;
  bool operator==(const DrawnBody&) const = default;
};

/// Red, green, blue, 0 .. 1. From the palette of M. Okabe and K. Ito, "Color universal design",
/// 2008, which most eyes tell apart.
struct Colour {
  float red = 0, green = 0, blue = 0;
};
constexpr Colour colour_of(DrawnAs kind) {
  switch (kind) {
    case DrawnAs::kMote:
      return {0.0F, 0.447F, 0.698F};
    case DrawnAs::kRobot:
      return {0.835F, 0.369F, 0.0F};
    case DrawnAs::kStation:
      return {0.0F, 0.620F, 0.451F};
    case DrawnAs::kWall:
      break;
  }
  return {0.6F, 0.6F, 0.6F};
}

}  // namespace hal
