#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/types/geometry.h"

namespace hal {

/// An upright shape for viewers, in the frame of the body that it belongs to.
struct Solid {
  /// Kind of shape, with the numbers of visualization_msgs/Marker.
  enum class Shape : std::uint8_t { kArrow = 0, kBox = 1, kSphere = 2, kCylinder = 3 };

  Shape shape = Shape::kBox;  ///< Which shape.
  Vec3 size;                  ///< m along its own axes. Arrow: length, width, height.
  Vec3 centre;                ///< m. Arrow: its start.
  double yaw = 0;             ///< rad, direction of its own x axis, counter-clockwise.
  bool operator==(const Solid&) const = default;  ///< Member by member.
};

/// Centre of a solid in the world, m. @param frame  pose of the body's frame in the world
Vec3 centre_in_world(const Solid& solid, const Pose2& frame);

/// What a body is; decides its colour.
enum class DrawnAs : std::uint8_t { kWall, kMote, kRobot, kStation };

/// A wall or the body of an agent as viewers draw it.
struct DrawnBody {
  std::string name;                                   ///< Name of the wall or agent.
  DrawnAs kind = DrawnAs::kWall;                      ///< What it is.
  std::vector<Solid> solids;                          ///< Its shapes, in the frame of the body.
  bool operator==(const DrawnBody&) const = default;  ///< Member by member.
};

/// A colour of the palette of M. Okabe and K. Ito, "Color universal design", 2008, which people
/// with colour vision deficiencies can distinguish, too.
struct Colour {
  float red = 0,  ///< 0 .. 1.
      green = 0,  ///< 0 .. 1.
      blue = 0;   ///< 0 .. 1.
};
/// Colour of a kind of body.
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
