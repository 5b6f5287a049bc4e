#include "sim/agents/agent_offer.h"

#include <string>
#include <utility>
#include <variant>

#include "hal/devices/wheel_drive.h"

namespace sim::agents {
namespace {

using hal::devices::RobotDescription;

hal::Channel channel(std::uint16_t id, std::string name, std::string kind, std::string unit) {
  return {.id = id,
          .name = std::move(name),
          .kind = std::move(kind),
          .unit = std::move(unit),
          .length = 0,
          .period = {},
          .frame = "base",
          .headings = {}};
}

void add_infrared(const RobotDescription& robot, std::vector<hal::Channel>& channels) {
  if (robot.infrared.empty()) return;
  hal::Channel infrared = channel(kInfrared, "infrared", "range", "m");
  infrared.length = static_cast<std::uint32_t>(robot.infrared.size());
  infrared.period = robot.infrared.front().hold_period;
  for (const auto& sensor : robot.infrared) infrared.headings.push_back(sensor.heading);
  hal::Channel volts = infrared;
  volts.id = kInfraredVolts;
  volts.name = "infrared_volts";
  volts.kind = "voltage";
  volts.unit = "V";
  channels.push_back(std::move(infrared));
  channels.push_back(std::move(volts));
}

void add_robot(const RobotDescription& robot, hal::exchange::AgentSession& session) {
  const hal::devices::WheelDrive drive(robot.wheels);
  session.kind = hal::AgentKind::kRobot;
  session.limits = {.body_to_wheel = drive.body_to_wheel(),
                    .wheel_to_body = drive.restrictions(),
                    .wheel_speed = drive.max_wheel_speed()};
  session.channels.push_back(channel(kOdometry, "odometry", "odometry", "m, rad, m/s"));
  session.channels.back().length = 6;
  add_infrared(robot, session.channels);
}

}  // namespace

hal::exchange::AgentOffer offer_of(const AgentConfig& agent, const SimulationConfig& config) {
  hal::exchange::AgentOffer offer;
  offer.program = agent.program;
  offer.session = {
      .agent = agent.id,
      .name = agent.name,
      .kind = hal::AgentKind::kMote,
      .seed = config.seed,
      .control_period = config.control_period,
      .parameters = agent.parameters,
      .channels = {channel(kLocalisation, "localisation", "relative_position", "address, m")},
      .limits = {}};
  const auto* robot = std::get_if<RobotDescription>(&agent.body);
  if (robot != nullptr) add_robot(*robot, offer.session);
  return offer;
}

}  // namespace sim::agents
