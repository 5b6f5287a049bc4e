#include "sim/agents/populated_world.h"

#include <variant>

#include "sim/agents/parking.h"

namespace sim::agents {

std::unique_ptr<physics::World> populated_world(const SimulationConfig& config) {
  auto world = std::make_unique<physics::World>(config.world);
  for (const physics::StaticBox& wall : config.walls) world->add_wall(wall);
  for (const AgentConfig& agent : config.agents) {
    const hal::Pose2 pose = agent.is_present ? agent.pose : parking(agent.id);
    if (const auto* mote = std::get_if<hal::node::devices::MoteDescription>(&agent.body)) {
      world->add_mote(agent.id, *mote, pose);
    } else if (const auto* robot = std::get_if<hal::node::devices::RobotDescription>(&agent.body)) {
      world->add_robot(agent.id, *robot, pose);
    }
  }
  for (const physics::Movable& movable : config.movables) world->add_movable(movable);
  return world;
}

}  // namespace sim::agents
