#include "hal/robot/agent/robot_file.h"

#include <array>
#include <limits>

#include "hal/files/config/document.h"
#include "hal/files/description/body_section.h"
#include "hal/files/description/field_io.h"
#include "hal/files/description/names.h"
#include "hal/files/description/priority_keys.h"
#include "hal/files/description/robot_checks.h"
#include "hal/files/description/routing_section.h"
#include "hal/files/description/static_routes.h"
#include "hal/node/devices/channels.h"
#include "hal/robot/agent/robot_file_sections.h"

namespace hal::robot::agent {
namespace {

using files::config::Mapping;
using files::config::Option;
using files::description::FieldReader;
using files::description::Fields;

constexpr std::array kKinds = {Option<AgentKind>{"robot", AgentKind::kRobot},
                               Option<AgentKind>{"mote", AgentKind::kMote}};

void agent_keys(Fields& io, RobotFile& file) {
  io.needed_text({"name", "Name of the agent: letters, digits, '_' and '-' after a letter.", "r0"},
                 file.name);
  files::description::check_name(io, file.name);
  // An invalid address is cleared, so that no landmark seems to use it.
  file.address = {};
  const files::config::Key address{
      "address", "Network address of the agent, the same as in the scenario of the simulator.",
      "26", files::config::kMustBeGiven};
  io.count(address, 1, kLastAddress, file.address.value);
  if (Mapping* in = io.reading(); in != nullptr && !in->has(address.name))
    in->integer(address, 1, kLastAddress);  // reports that it is missing
  io.needed_choice({"kind", "Whether the agent is a robot or a mote.", "robot"}, kKinds, file.kind);
}

void controller_keys(Fields& io, RobotFile& file) {
  io.given_text(
      {"program", "The only controller that the agent accepts; without it, any.", "help_robot"},
      file.program);
  const bool has_air = io.given_text(
      {"air_interface",
       "Network interface on which the controller may open its own sockets and DDS participants.",
       "wlan0"},
      file.air_interface);
  if (has_air) file.air_interface_place = io.reading()->place("air_interface");
  if (has_air && file.air_interface.empty()) io.mistake("air_interface", "is empty");
  const files::config::Key parameters{
      "parameters", "Parameters of the controller; `baraka describe PROGRAM` lists them.",
      "{speed: 0.5 m/s}"};
  io.own(
      parameters, {.kind = files::config::Form::Kind::kMapping},
      [&](Mapping& in) {
        for (files::config::PlainValue& given : in.mapping(parameters).nested_values()) {
          file.parameters.push_back({std::move(given.key), std::move(given.text),
                                     std::move(given.place), given.is_list,
                                     std::move(given.items)});
        }
      },
      [](files::config::Writer& /*out*/) {});
}

void keys_of(Fields& io, RadioSettings& c) {
  io.needed_text(
      {"interface",
       "Network interface that the radio uses; all agents must be on the same network.", "wlan0"},
      c.interface);
  io.given_text({"address", "IPv4 address of the interface to use; without it, the first one.",
                 "192.168.0.5"},
                c.address);
  io.count({"port", "UDP port, the same for all agents.", "7300"}, 1, 0xffff, c.port);
  io.number({"bit_rate", "Nominal bit rate, used for the delay statistics of routes.", "6 Mb/s"},
            "b/s", {1, 1e12}, c.bit_rate);
  io.number({"power", "Transmit power, used for the energy statistics of routes.", "100 mW"}, "W",
            {0, 100}, c.power);
}

RadioPlaces places_of(const Mapping& in) {
  return {in.place("interface"), in.place("address"), in.place("port")};
}

void times_keys(Fields& io, RobotFile& file) {
  io.count({"seed", "Seed of the random streams of controller and router.", "1"}, 0,
           std::numeric_limits<std::int64_t>::max(), file.seed);
  io.duration({"control_period", "Time between two calls of the controller's step().", "100 ms"},
              {1e-3, 10}, file.control_period);
  io.duration(
      {"command_timeout",
       "Time without a command after which the wheels stop; at least `control_period`.", "500 ms"},
      {1e-3, 3600}, file.command_timeout);
  if (file.command_timeout < file.control_period) {
    io.mistake("command_timeout",
               "must not be shorter than control_period: the wheels would stop between commands");
  }
}

/// Finds the agent's own among the routes, which name the agent itself and those of the map.
void find_static_routes(Fields& io, RobotFile& file) {
  if (io.reading() == nullptr || file.routing.algorithm != node::routing::Algorithm::kStatic)
    return;
  std::vector<files::description::NamedAgent> names{{file.name, file.address}};
  for (const Landmark& one : file.localisation.map) names.push_back({one.name, one.agent});
  auto routes = files::description::static_routes(io.reading()->within("routing"),
                                                  file.routing.statics.rows, names);
  if (!routes.empty()) file.routing.statics.routes = std::move(routes.front());
}

/// A robot has a body and devices, a mote has neither.
void body_keys(Fields& io, RobotFile& file) {
  const bool is_robot = file.kind == AgentKind::kRobot;
  file.robot.emplace();
  io.only(is_robot, {"agent.kind", {"robot"}}, "a mote has none", [&](Fields& robot) {
    robot.inside(
        {"robot",
         "Geometry of body, wheels and sensors, usually {include: ../robots/robotino.yaml}."},
        [&](Fields& keys) {
          keys_of(keys, *file.robot);
          if (Mapping* in = keys.reading())
            files::description::check_robot(*in, *file.robot, files::description::kEarthGravity);
        });
    device_keys(robot, file);
  });
  if (!is_robot) file.robot.reset();
}

}  // namespace

void keys_of(Fields& io, RobotFile& file) {
  files::description::needed_version_key(io);
  io.inside({"agent", "Name, address and kind of the agent."},
            [&](Fields& agent) { agent_keys(agent, file); });
  io.inside({"controller", "The controller of the agent."},
            [&](Fields& controller) { controller_keys(controller, file); });
  times_keys(io, file);
  io.inside({"radio", "The radio, which sends UDP datagrams over a network interface."},
            [&](Fields& radio) {
              if (radio.reading() != nullptr) file.radio_places = places_of(*radio.reading());
              keys_of(radio, file.radio);
            });
  files::description::routing_key(io, file.routing, node::routing::LinkCapabilities{});
  files::description::priorities_key(io, file.routing.priorities);
  io.inside({"localisation", "How the agent knows its own pose and the positions of other agents."},
            [&](Fields& own) { localisation_keys(own, file.localisation, file); });
  find_static_routes(io, file);
  body_keys(io, file);
}

RobotFile RobotFile::read(Mapping in) {
  RobotFile file;
  FieldReader io(in);
  keys_of(io, file);
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
