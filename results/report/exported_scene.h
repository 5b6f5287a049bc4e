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
  double field_of_view = 0;  ///< rad, full angle
  double low = 0, high = 0;  ///< m, measuring range
  hal::Vec3 position{};      ///< m, in the frame of the body
  double heading = 0;        ///< rad, in the frame of the body
};

struct ExportedAgent {
  bool drives = false;
  hal::Pose2 start;  ///< In the world.
  hal::DrawnBody body;
  std::vector<ExportedRange> ranges;
  std::vector<hal::Channel> channels;  ///< The channels of `sensors:` in its file.
};

/// The shapes and sensors of the agents. The tables of a result lack them; they come from its
/// scenario.
struct ExportedScene {
  std::map<std::int64_t, ExportedAgent> agents;  ///< By address.
  std::vector<hal::DrawnBody> walls;             ///< In the world.
};

}  // namespace results::report
