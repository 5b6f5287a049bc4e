#include "baraka/commands/exported_scene_of.h"

#include <variant>

#include "hal/node/devices/channels.h"
#include "sim/agents/drawn_bodies.h"
#include "sim/scenario/scenario.h"

namespace baraka::commands {
namespace {

results::report::ExportedAgent exported(const sim::agents::AgentConfig& agent) {
  results::report::ExportedAgent told;
  told.start = agent.pose;
  told.body = sim::agents::drawn_body(agent);
  told.channels = hal::node::devices::sensor_channels(sim::agents::sensors_of(agent));
  const auto* robot = std::get_if<hal::node::devices::RobotDescription>(&agent.body);
  if (robot == nullptr) return told;
  told.drives = true;
  for (const hal::node::devices::InfraredSensor& sensor : robot->infrared) {
    told.ranges.push_back({.field_of_view = 2 * sensor.half_angle,
                           .low = sensor.curve.min_range(),
                           .high = sensor.curve.max_range(),
                           .position = sensor.position,
                           .heading = sensor.heading});
  }
  return told;
}

}  // namespace

results::report::ExportedScene exported_scene_of(const std::filesystem::path& folder) {
  const auto scenario = sim::scenario::load_scenario(folder / "scenario.resolved.yaml");
  results::report::ExportedScene scene;
  for (const sim::agents::AgentConfig& agent : scenario.simulation.agents) {
    scene.agents[agent.id.value] = exported(agent);
  }
  for (const auto& wall : scenario.simulation.walls) {
    scene.walls.push_back(sim::agents::drawn_body(wall));
  }
  return scene;
}

}  // namespace baraka::commands
