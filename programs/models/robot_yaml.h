#pragma once

#include <string>

#include "programs/models/robot.h"

namespace programs::models {

/// A robot file: YAML whose values read back to the same bits. `# line N` after a value is where
/// the model has it, and lines `# left out: line N: WHAT` say first what the robot does not have.
std::string robot_yaml(const Robot& robot, const std::string& file);

}  // namespace programs::models
