#pragma once

#include <string>
#include <string_view>

namespace idl::ros {

/// The definition of a ROS 2 message (release Humble Hawksbill, or ours of idl/inspect.idl) with
/// those of all messages in it, as MCAP's schema encoding `ros2msg` has them (mcap.dev, "MCAP File
/// Format Registry").
/// @param type  "geometry_msgs/msg/PoseStamped".  @throws std::out_of_range  it is not known.
std::string schema(std::string_view type);

}  // namespace idl::ros
