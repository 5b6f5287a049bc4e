#pragma once

#include <optional>
#include <string>
#include <vector>

#include "programs/models/drive_keys.h"
#include "programs/models/merge.h"
#include "programs/models/model.h"
#include "programs/models/upright.h"

namespace programs::models {

/// A wheel or a caster of a robot file. Body frame: that of the model, lowered so that z = 0 is the
/// ground below the wheels.
struct RobotWheel {
  std::string type;          ///< fixed, omni, mecanum or caster.
  Eigen::Vector2d position;  ///< m
  double axis = 0;           ///< rad; a positive speed drives to its left.
  double radius = 0;         ///< m
  double mass = 0;           ///< kg
  std::optional<double> mu{}, effort{}, velocity{};
  std::optional<double> roller_angle{};  ///< rad
  Line line = 0;
};

/// A collision shape of the body.
struct RobotShape {
  Upright shape;
  Line line = 0;
};

/// A sensor on the body.
struct RobotSensor {
  Sensor sensor;
  Eigen::Vector3d position;  ///< m
  double heading = 0;        ///< rad
};

/// What a robot file says, from a model.
struct Robot {
  std::string model;
  Inertial inertia;  ///< Of all but the driven wheels.
  std::optional<double> friction{};
  std::vector<RobotShape> shapes;
  std::vector<RobotWheel> wheels;
  std::optional<double> acceleration{};  ///< m/s^2
  std::vector<RobotSensor> sensors;
  std::vector<Note> notes;  ///< By line.
  Line line = 0;
};

/// Links that hold together over joints that are no wheel's make the body, at the joints' zero.
/// Casters are the links that are chosen, else the balls among collision shapes that touch the
/// ground within 3 mm; they are part of the body's mass. Of the driven wheels, the outline counts
/// as a shape of the body, for wheels meet nothing but the ground.
/// @throws ModelError, DriveError
Robot robot_of(const Model& model, const DriveChoice& choice);

}  // namespace programs::models
