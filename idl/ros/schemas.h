#pragma once

#include <string>
#include <string_view>

namespace idl::ros {

/// The definition of a ROS 2 message (release Humble Hawksbill, or of this project:
/// idl/inspect.idl) with those of all messages in it, in MCAP's schema encoding `ros2msg`
/// (mcap.dev, "MCAP File Format Registry").
/// @param type  "geometry_msgs/msg/PoseStamped".  @throws std::out_of_range  it is unknown.
std::string schema(std::string_view type);

}  // namespace idl::ros
