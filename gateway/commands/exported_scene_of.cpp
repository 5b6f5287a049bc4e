#include "gateway/commands/exported_scene_of.h"

#include <variant>

#include "hal/devices/channels.h"
#include "sim/agents/drawn_bodies.h"
#include "sim/scenario/scenario.h"

namespace gateway {
namespace {

sim::report::ExportedAgent exported(const sim::agents::AgentConfig& agent) {
  sim::report::ExportedAgent told;
  told.start = agent.pose;
  told.body = sim::agents::drawn_body(agent);
  told.channels = hal::devices::sensor_channels(sim::agents::sensors_of(agent));
  const auto* robot = std::get_if<hal::devices::RobotDescription>(&agent.body);
  if (robot == nullptr) return told;
  told.drives = true;
  for (const hal::devices::InfraredSensor& sensor : robot->infrared) {
    told.ranges.push_back({.field_of_view = 2 * sensor.half_angle,
                           .low = sensor.curve.min_range(),
                           .high = sensor.curve.max_range(),
                           .position = sensor.position,
                           .heading = sensor.heading});
  }
  return told;
}

}  // namespace

sim::report::ExportedScene exported_scene_of(const std::filesystem::path& folder) {
  const auto scenario = sim::scenario::load_scenario(folder / "scenario.resolved.yaml");
  sim::report::ExportedScene scene;
  for (const sim::agents::AgentConfig& agent : scenario.simulation.agents) {
    scene.agents[agent.id.value] = exported(agent);
  }
  for (const auto& wall : scenario.simulation.walls) {
    scene.walls.push_back(sim::agents::drawn_body(wall));
  }
  return scene;
}

}  // namespace gateway
