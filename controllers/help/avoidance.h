#pragma once

#include <optional>
#include <vector>

#include "hal/api/robot.h"
#include "hal/types/geometry.h"
#include "hal/types/time.h"

namespace controllers {

/// Drives a holonomic robot towards a distant point and around obstacles, using only infrared
/// sensors.
///
///             obstacle ahead, near: picks a side
///   towards the point -----------------------> along the wall --+ patience used up: other side,
///            ^                                        |    ^    | twice the patience
///            +----------------------------------------+    +----+
///                 the way has been clear for a while
///
/// The bearing of the point serves as a compass: memories of a wall are stored relative to it.
/// Doubling the patience finds the end of any wall (Baeza-Yates, Culberson, Rawlins, "Searching in
/// the Plane", 1993). The body turns so that a sensor faces the direction of travel.
class Avoidance {
 public:
  struct Limits {
    double speed = 0;        ///< m/s, > 0.
    double body_radius = 0;  ///< m, from the centre to the sensors.
    double gap = 0;          ///< m, kept between body and wall.
    /// Time for which the way must be clear before the robot leaves a wall.
    hal::Duration clear_for{};
  };

  explicit Avoidance(const Limits& limits) : limits_(limits) {}

  /// The velocity for the next control cycle, body frame.
  /// @param way  unit vector towards the point, body frame.
  hal::Twist2 steer(hal::Vec2 way, const std::vector<hal::InfraredReading>& infrared,
                    hal::Time now);

  /// Call when `way` begins to refer to another point: stored knowledge of walls becomes invalid.
  void aim_anew() { *this = Avoidance(limits_); }

  bool follows_wall() const { return following_; }

 private:
  using Points = std::vector<hal::Vec2>;  ///< Detected surfaces, by distance; m in the body frame.

  Points points_of(const std::vector<hal::InfraredReading>& infrared) const;
  std::optional<double> gap_along(hal::Vec2 direction, const Points& seen, double width) const;
  void update_state(hal::Vec2 way, const Points& seen, hal::Time now);
  void start_following(hal::Vec2 way, const Points& seen, hal::Time now);
  void look_at_wall(hal::Vec2 way, const Points& seen);
  hal::Vec2 towards_point(hal::Vec2 way, const Points& seen) const;
  hal::Vec2 along_wall(hal::Vec2 way, const Points& seen, hal::Time now) const;
  hal::Vec2 away_from_near(hal::Vec2 velocity, const Points& seen) const;
  double wall_width() const { return limits_.body_radius + limits_.gap; }

  Limits limits_;
  bool following_ = false;
  /// Direction from the wall to the robot, in the frame whose x axis is the way.
  hal::Vec2 normal_{};
  double side_ = 1;  ///< 1: the wall is to the left of the direction of travel; -1: to the right.
  std::optional<hal::Time> last_following_;  ///< nullopt: no wall so far.
  hal::Time following_since_{};
  hal::Time last_blocked_{};
  hal::Time side_since_{};
  hal::Duration patience_{};
};

}  // namespace controllers
