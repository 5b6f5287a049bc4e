#pragma once

#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <string_view>

#include "programs/models/model.h"

namespace programs::models {

/// Numbers in XML, read strictly: each of these names the element's line if a text is not what it
/// should be. @throws ModelError

using Element = tinyxml2::XMLElement;

/// "<link> 'base'", for messages.
std::string title(const Element& element);

/// An attribute that must be there.
std::string text_of(const Element& element, const char* attribute);
double number_of(const Element& element, const char* attribute);
std::optional<double> number_if_there(const Element& element, const char* attribute);
/// Three numbers. @param otherwise  if the attribute is absent
Eigen::Vector3d vector_of(const Element& element, const char* attribute,
                          const Eigen::Vector3d& otherwise);
/// A finite number. @throws ModelError
double parsed_number(std::string_view text, const Element& element, const char* what);

/// Pose from roll, pitch, yaw about fixed axes. rad
Eigen::Isometry3d pose_from(const Eigen::Vector3d& xyz, const Eigen::Vector3d& rpy);
/// Pose in the child `origin`; absent: none.
Eigen::Isometry3d origin_of(const Element& element);

}  // namespace programs::models
