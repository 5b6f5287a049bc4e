#include "hal/robot/agent/robot_file.h"

#include <fmt/format.h>

#include <array>
#include <limits>

#include "hal/files/config/document.h"
#include "hal/files/config/mapping.h"
#include "hal/files/description/body_section.h"
#include "hal/files/description/names.h"
#include "hal/files/description/routing_section.h"
#include "hal/node/devices/channels.h"
#include "hal/robot/agent/robot_file_sections.h"

namespace hal::robot::agent {
namespace {

using files::config::Key;
using files::config::Mapping;
using files::config::Option;

constexpr std::array kKinds = {Option<AgentKind>{"robot", AgentKind::kRobot},
                               Option<AgentKind>{"mote", AgentKind::kMote}};

void read_agent(Mapping in, RobotFile& file) {
  file.name = in.text({"name", "Of the agent: letters, digits, '_' and '-' after a letter.", "r0"});
  if (!file.name.empty() && !files::description::may_be_named(file.name)) {
    in.mistake("name",
               fmt::format("'{}' must be letters, digits, '_' and '-' after a letter", file.name));
  }
  // A mistaken address is nobody's: it must not seem to be taken by a landmark.
  const Key address{"address", "Network address, the same as in the simulator's scenario.", "26",
                    files::config::kMustBeGiven};
  if (!in.has("address")) in.integer(address, 1, kLastAddress);
  file.address = AgentId{static_cast<std::uint16_t>(in.integer(address, 1, kLastAddress, 0))};
  file.kind = in.choice({"kind", "What the agent is.", "robot"}, kKinds).value_or(AgentKind::kMote);
  in.finish();
}

void read_controller(Mapping in, RobotFile& file) {
  if (in.has("program"))
    file.program =
        in.text({"program", "The controller this agent is for; others are refused.", "help_robot"});
  if (in.has("air_interface")) {
    file.air_interface = in.text({"air_interface",
                                  "Network interface on which the controller may open sockets and "
                                  "DDS participants of its own.",
                                  "wlan0"});
    file.air_interface_place = in.place("air_interface");
    if (file.air_interface.empty()) in.mistake("air_interface", "is empty");
  }
  Mapping parameters =
      in.mapping({"parameters", "Of the controller; `baraka describe PROGRAM` shows them.",
                  "{speed: 0.5 m/s}"});
  for (files::config::PlainValue& given : parameters.nested_values()) {
    file.parameters.push_back({std::move(given.key), std::move(given.text), std::move(given.place),
                               given.is_list, std::move(given.items)});
  }
  in.finish();
}

RadioSettings read_radio(Mapping in, RadioPlaces& places) {
  RadioSettings radio;
  places = {in.place("interface"), in.place("address"), in.place("port")};
  radio.interface =
      in.text({"interface", "Network interface; the same network for all agents.", "wlan0"});
  if (in.has("address"))
    radio.address = in.text(
        {"address", "One of the interface's addresses; absent: its first one.", "192.168.0.5"});
  radio.port = static_cast<std::uint16_t>(
      in.integer({"port", "UDP port, the same for all agents.", "7300"}, 1, 0xffff, radio.port));
  radio.bit_rate = in.number({"bit_rate", "Nominal, for the delay statistics of routes.", "6 Mb/s"},
                             "b/s", {1, 1e12}, radio.bit_rate);
  radio.power =
      in.number({"power", "Of the transmitter, for the energy statistics of routes.", "100 mW"},
                "W", {0, 100}, radio.power);
  in.finish();
  return radio;
}

void read_times(Mapping& in, RobotFile& file) {
  file.seed = static_cast<std::uint64_t>(
      in.integer({"seed", "Of the controller's and the router's random streams.", "1"}, 0,
                 std::numeric_limits<std::int64_t>::max(), 1));
  file.control_period =
      in.duration({"control_period", "Between two calls of the controller's step().", "100 ms"},
                  {1e-3, 10}, file.control_period);
  file.command_timeout = in.duration(
      {"command_timeout",
       "Without a command for so long the wheels stop; not shorter than `control_period`.",
       "500 ms"},
      {1e-3, 3600}, file.command_timeout);
  if (file.command_timeout < file.control_period) {
    in.mistake("command_timeout",
               "must not be shorter than control_period: the wheels would stop between commands");
  }
}

/// A robot has a body and devices, a mote has neither.
void read_body(Mapping& in, RobotFile& file) {
  if (file.kind == AgentKind::kRobot) {
    file.robot = files::description::read_robot(in.mapping(
        {"robot",
         "Geometry of body, wheels and sensors, mostly {include: ../robots/robotino.yaml}."}));
    read_devices(in, file);
    return;
  }
  for (const std::string key :
       {"robot", "wheels", "infrared", "sensors", "limits", "on_lost_sensor"}) {
    in.refuse(key, "a mote has none");
  }
}

}  // namespace

RobotFile RobotFile::read(Mapping in) {
  RobotFile file;
  in.integer({"version", "Of the format of this file.", "1"}, 1, 1);
  read_agent(in.mapping({"agent", "Who the agent is."}), file);
  read_controller(in.mapping({"controller", "The program that drives it."}), file);
  read_times(in, file);
  file.radio = read_radio(in.mapping({"radio", "The UDP radio."}), file.radio_places);
  file.routing = files::description::read_routing(in, node::routing::LinkCapabilities{});
  file.localisation = read_localisation(
      in.mapping({"localisation", "How the agent knows where it and the others are."}), file);
  read_body(in, file);
  in.finish();
  return file;
}

RobotFile RobotFile::load(const std::filesystem::path& path,
                          const std::vector<std::string>& overrides) {
  auto document = files::config::Document::load(path, overrides);
  RobotFile file = read(document.root());
  document.finish();
  file.warnings = document.warnings();
  return file;
}

std::unique_ptr<drivers::WheelDriver> make_wheels(const RobotFile& file) {
  if (!file.wheels) return nullptr;
  return file.wheels->make({*file.robot, file.limits, file.command_timeout});
}

std::unique_ptr<drivers::InfraredDriver> make_infrared(const RobotFile& file) {
  if (!file.infrared) return nullptr;
  return file.infrared->make({*file.robot, file.limits, file.command_timeout});
}

std::vector<std::unique_ptr<drivers::SensorDriver>> make_sensors(const RobotFile& file) {
  std::vector<std::unique_ptr<drivers::SensorDriver>> drivers;
  for (const drivers::DrivenSensor& one : file.sensors) drivers.push_back(one.driver->make());
  return drivers;
}

std::vector<Channel> sensor_channels(const RobotFile& file) {
  std::vector<Channel> channels;
  if (file.sensors.empty()) return channels;
  const std::vector<Channel> all = node::devices::sensor_channels(file.robot->sensors);
  for (const drivers::DrivenSensor& one : file.sensors) {
    channels.push_back(all.at(one.sensor));
    channels.back().period = one.driver->period();
  }
  return channels;
}

std::unique_ptr<PoseSource> make_static_pose(const RobotFile& file) {
  const Pose2* pose = std::get_if<Pose2>(&file.localisation.source);
  return pose == nullptr ? nullptr : std::make_unique<StaticPose>(*pose);
}

}  // namespace hal::robot::agent
