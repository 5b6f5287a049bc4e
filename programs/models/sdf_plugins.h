#pragma once

#include <sdf/Element.hh>

#include "programs/models/model.h"

namespace programs::models {

/// Adds what the plug-ins of a model say: a differential drive, of Gazebo (gz::sim::systems::
/// DiffDrive), of gazebo_ros (diff_drive) or of an older one. All others become notes.
void add_plugins(const ::sdf::ElementPtr& model, Model& to);

}  // namespace programs::models
