#pragma once

#include <string>

#include "hal/types/geometry.h"

namespace hal::node::devices {

/// A sensor's name and its pose on the body.
struct Mount {
  std::string name;    ///< Name of its channel and of its frame.
  Vec3 position;       ///< m, body frame
  double heading = 0;  ///< rad, of its x axis, about z of the body frame
  bool operator==(const Mount&) const = default;
};

}  // namespace hal::node::devices
