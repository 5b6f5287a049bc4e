#pragma once

#include <span>
#include <string>

#include "hal/api/robot.h"

namespace controllers {

/// The robot as URDF (wiki.ros.org/urdf/XML): links with the shapes that collide, continuous joints
/// of the driven wheels with axis and limits, fixed joints of sensors and casters. What its file
/// does not say is left out: masses, meshes, and the shape of the wheels, whose width is unknown;
/// of casters, which are balls, the shape is there.
/// @param root  link of which base_link is a part; "base_link": none.
std::string urdf_of(const hal::RobotBody& body, std::span<const hal::Channel> channels,
                    const std::string& root);

}  // namespace controllers
