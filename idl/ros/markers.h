#pragma once

#include <string>
#include <vector>

#include "hal/types/geometry.h"
#include "hal/types/solid.h"
#include "hal/types/time.h"
#include "inspect.h"

namespace idl::ros {

/// A body and its pose in the world.
struct PlacedBody {
  const hal::DrawnBody& body;
  const hal::Pose2& pose;
};

/// Adds one marker in frame "world" for each solid of a body. Their `ns` is `name`.
void add_markers(std::vector<visualization_msgs::msg::dds_::Marker_>& markers, hal::Time at,
                 const std::string& name, const PlacedBody& placed);

}  // namespace idl::ros
