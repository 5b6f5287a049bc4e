#include "sim/agents/agent_offer.h"

#include <algorithm>
#include <iterator>
#include <variant>

#include "hal/node/devices/channels.h"
#include "hal/node/devices/robot_outline.h"
#include "hal/node/devices/wheel_drive.h"

namespace sim::agents {
namespace {

namespace devices = hal::node::devices;
using hal::node::devices::RobotDescription;

void add_robot(const RobotDescription& robot, hal::node::exchange::AgentSession& session) {
  const hal::node::devices::WheelDrive drive(robot.wheels);
  session.kind = hal::AgentKind::kRobot;
  session.limits = {.body_to_wheel = drive.body_to_wheel(),
                    .wheel_to_body = drive.restrictions(),
                    .wheel_speed = drive.max_wheel_speed()};
  session.body = hal::node::devices::body_of(robot);
}

void add_channels(const RobotDescription& robot, std::vector<hal::Channel>& channels) {
  channels.push_back(devices::odometry_channel());
  if (robot.infrared.empty()) return;
  const hal::Duration period = robot.infrared.front().hold_period;
  std::ranges::copy(devices::infrared_channels(robot.infrared, period),
                    std::back_inserter(channels));
}

}  // namespace

std::vector<hal::Channel> channels_of(const AgentConfig& agent) {
  std::vector<hal::Channel> channels{devices::localisation_channel()};
  const auto* robot = std::get_if<RobotDescription>(&agent.body);
  if (robot != nullptr) add_channels(*robot, channels);
  std::ranges::copy(devices::sensor_channels(sensors_of(agent)), std::back_inserter(channels));
  return channels;
}

hal::node::exchange::AgentOffer offer_of(const AgentConfig& agent, const SimulationConfig& config) {
  hal::node::exchange::AgentOffer offer;
  offer.program = agent.program;
  offer.session = {.agent = agent.id,
                   .name = agent.name,
                   .kind = hal::AgentKind::kMote,
                   .seed = config.seed,
                   .control_period = config.control_period,
                   .parameters = agent.parameters,
                   .channels = channels_of(agent),
                   .limits = {},
                   .air_interface = agent.inside ? kAirInterface : ""};
  const auto* robot = std::get_if<RobotDescription>(&agent.body);
  if (robot != nullptr) add_robot(*robot, offer.session);
  return offer;
}

}  // namespace sim::agents
