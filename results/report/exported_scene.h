#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hal/types/channel.h"
#include "hal/types/geometry.h"
#include "hal/types/solid.h"

namespace results::report {

/// An infrared sensor of a robot.
struct ExportedRange {
  double field_of_view = 0;  ///< rad, whole angle
  double low = 0, high = 0;  ///< m, what it can measure
  hal::Vec3 position{};      ///< m, in the frame of the body
  double heading = 0;        ///< rad, likewise
};

struct ExportedAgent {
  bool drives = false;
  hal::Pose2 start;  ///< In the world.
  hal::DrawnBody body;
  std::vector<ExportedRange> ranges;
  std::vector<hal::Channel> channels;  ///< Of `sensors:` of its file.
};

/// What the tables of a result do not say and its scenario does: what agents look like and what
/// they sense with.
struct ExportedScene {
  std::map<std::int64_t, ExportedAgent> agents;  ///< By address.
  std::vector<hal::DrawnBody> walls;             ///< In the world.
};

}  // namespace results::report
