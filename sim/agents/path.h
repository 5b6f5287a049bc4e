#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "hal/types/geometry.h"
#include "hal/types/time.h"

namespace sim::agents {

/// A straight line from the agent's pose ahead, then back, and so on.
struct LinePath {
  double speed = 0;                                         ///< m/s, > 0
  double length = std::numeric_limits<double>::infinity();  ///< m, > 0; infinite: never turns back.
  hal::Duration pause{};                                    ///< At either end.
  bool operator==(const LinePath&) const = default;
};

/// A circle whose centre is on the left of the agent's pose, or, clockwise, on its right.
struct CirclePath {
  double radius = 0;  ///< m, > 0
  double speed = 0;   ///< m/s, > 0
  bool clockwise = false;
  bool operator==(const CirclePath&) const = default;
};

/// Straight lines from the agent's pose to the points, one after the other.
struct WaypointPath {
  std::vector<hal::Vec2> points;  ///< m, world frame; at least one, neighbours differ.
  double speed = 0;               ///< m/s, > 0
  hal::Duration pause{};          ///< At each point.
  bool repeat = false;  ///< Continues from the last point to the first; else the agent stays there.
  bool operator==(const WaypointPath&) const = default;
};

/// Straight lines to points drawn uniformly from a rectangle, one after the other, each at a speed
/// drawn uniformly (D. B. Johnson and D. A. Maltz, "Dynamic Source Routing in Ad Hoc Wireless
/// Networks", 1996). The lowest speed is above 0, because otherwise the mean speed would decrease
/// for ever (J. Yoon, M. Liu and B. Noble, "Random Waypoint Considered Harmful", INFOCOM 2003).
struct RandomWaypointPath {
  hal::Vec2 from, to;     ///< m, corners, world frame
  double speed_low = 0;   ///< m/s, > 0
  double speed_high = 0;  ///< m/s, >= speed_low
  hal::Duration pause{};  ///< At each point.
  bool operator==(const RandomWaypointPath&) const = default;
};

/// How an agent without a body moves. std::monostate: it stays where it is.
using PathDescription =
    std::variant<std::monostate, LinePath, CirclePath, WaypointPath, RandomWaypointPath>;

/// State of an agent on a path.
struct PathState {
  hal::Vec2 position;       ///< m, world frame
  hal::Vec2 velocity;       ///< m/s
  double heading = 0;       ///< rad
  hal::Time valid_until{};  ///< The position holds until then (exclusive); max(): for ever.
};

/// A path in closed form: computed only on request.
class Path {
 public:
  virtual ~Path() = default;
  /// @param at  >= Time{}. Ascending times are fastest; the result does not depend on the order.
  virtual PathState at(hal::Time at) const = 0;
  virtual double max_speed() const = 0;  ///< m/s
};

/// @param start  at time 0, world frame.
/// @param seed,agent  name the stream "<agent>/path" from which random paths draw.
std::unique_ptr<Path> make_path(const PathDescription& description, const hal::Pose2& start,
                                std::uint64_t seed, const std::string& agent);

}  // namespace sim::agents
