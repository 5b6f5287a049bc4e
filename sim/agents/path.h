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

/// Straight on from where the agent stands, where it looks; and back, and so on.
struct LinePath {
  double speed = 0;                                         ///< m/s, > 0
  double length = std::numeric_limits<double>::infinity();  ///< m, > 0; infinite: on for ever.
  hal::Duration pause{};                                    ///< At either end.
  bool operator==(const LinePath&) const = default;
};

/// Round a centre on the left of where the agent stands and looks, or on its right.
struct CirclePath {
  double radius = 0;  ///< m, > 0
  double speed = 0;   ///< m/s, > 0
  bool clockwise = false;
  bool operator==(const CirclePath&) const = default;
};

/// From where the agent stands to the points, one after the other.
struct WaypointPath {
  std::vector<hal::Vec2> points;  ///< m, world frame; at least one, neighbours differ.
  double speed = 0;               ///< m/s, > 0
  hal::Duration pause{};          ///< At each point.
  bool repeat = false;            ///< From the last point to the first; else it stays there.
  bool operator==(const WaypointPath&) const = default;
};

/// To points drawn uniformly from a rectangle, one after the other, each at a speed drawn uniformly
/// (D. B. Johnson and D. A. Maltz, "Dynamic Source Routing in Ad Hoc Wireless Networks", 1996). The
/// least speed is above 0: else the mean speed would fall for ever (J. Yoon, M. Liu and B. Noble,
/// "Random Waypoint Considered Harmful", INFOCOM 2003).
struct RandomWaypointPath {
  hal::Vec2 from, to;     ///< m, corners, world frame
  double speed_low = 0;   ///< m/s, > 0
  double speed_high = 0;  ///< m/s, >= speed_low
  hal::Duration pause{};  ///< At each point.
  bool operator==(const RandomWaypointPath&) const = default;
};

/// How an agent without a body moves. std::monostate: it stands.
using PathDescription =
    std::variant<std::monostate, LinePath, CirclePath, WaypointPath, RandomWaypointPath>;

/// Where an agent on a path is.
struct PathState {
  hal::Vec2 position;       ///< m, world frame
  hal::Vec2 velocity;       ///< m/s
  double heading = 0;       ///< rad
  hal::Time valid_until{};  ///< It is there until then (exclusive); max(): for ever.
};

/// A path in closed form: costs nothing until somebody asks.
class Path {
 public:
  virtual ~Path() = default;
  /// @param at  >= Time{}. Cheapest in ascending order; the answers do not depend on the order.
  virtual PathState at(hal::Time at) const = 0;
  virtual double max_speed() const = 0;  ///< m/s
};

/// @param start  at time 0, world frame.
/// @param seed, agent  name the stream "<agent>/path" that random paths draw from.
std::unique_ptr<Path> make_path(const PathDescription& description, const hal::Pose2& start,
                                std::uint64_t seed, const std::string& agent);

}  // namespace sim::agents
