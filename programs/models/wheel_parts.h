#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "programs/models/model.h"

namespace programs::models {

/// Motors with more grip tip robots over.
inline constexpr double kHighestFriction = 1;

/// The wheel that each link turns with; a link that turns with none is absent.
using WheelOfLink = std::map<std::string, const Joint*>;

/// What turns with a joint, together.
struct WheelParts {
  double mass = 0;         ///< kg
  double radius = 0;       ///< m, of the farthest collision shape; 0: there is none.
  Eigen::Vector3d centre;  ///< m, the middle of these shapes on the axis; of the joint without any
  std::optional<double> mu{};
};

/// @param notes  receives frictions that are not above 0 and at most kHighestFriction.
WheelParts parts_of_wheel(const Model& model, const WheelOfLink& wheels, const Joint& joint,
                          std::vector<Note>& notes);

}  // namespace programs::models
