#pragma once

#include <fmt/format.h>

#include <vector>

#include "gateway/inspection/inspector.h"
#include "hal/node/devices/robot_description.h"

namespace gateway::inspection {

/// The infrared sensors of a simulated or real robot as published to DDS tools: "infrared_0",
/// "infrared_1", … in the order of the robot's file.
inline std::vector<InspectedRange> inspected_ranges(
    const std::vector<hal::node::devices::InfraredSensor>& sensors) {
  std::vector<InspectedRange> ranges;
  ranges.reserve(sensors.size());
  for (const hal::node::devices::InfraredSensor& sensor : sensors) {
    ranges.push_back({.name = fmt::format("infrared_{}", ranges.size()),
                      .field_of_view = 2 * sensor.half_angle,
                      .min_range = sensor.curve.min_range(),
                      .max_range = sensor.curve.max_range(),
                      .position = sensor.position,
                      .heading = sensor.heading});
  }
  return ranges;
}

}  // namespace gateway::inspection
