#pragma once

#include <array>
#include <optional>
#include <vector>

#include "hal/api/robot.h"

namespace controllers {

/// Angles and speeds of a robot's driven wheels, from its odometry: the inverse of the kinematics
/// by which odometry is made of the wheels' angles. It is exact if the wheels obey the kinematics:
/// always for two fixed or three omnidirectional wheels; with more wheels the part of their motion
/// that contradicts the others is missing.
class WheelAngles {
 public:
  /// Rows as in G. Campion, G. Bastin, B. D'Andrea-Novel, "Structural Properties and Classification
  /// of Kinematic and Dynamic Models of Wheeled Mobile Robots", IEEE T-RA, 1996. Casters are left
  /// out.
  explicit WheelAngles(const hal::RobotBody& body);

  /// Takes the odometry of a control cycle. Between two calls the body is taken to have moved along
  /// one arc.
  void update(const hal::Odometry& odometry);

  const std::vector<double>& angles() const { return angles_; }  ///< rad since the first update.
  const std::vector<double>& speeds() const { return speeds_; }  ///< rad/s

 private:
  std::vector<std::array<double, 3>> rows_;
  std::vector<double> angles_, speeds_;
  std::optional<hal::Pose2> last_;
};

}  // namespace controllers
