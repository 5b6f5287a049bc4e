#include "hal/hardware/robot_file.h"

#include <fmt/format.h>

#include <array>
#include <limits>

#include "hal/config/document.h"
#include "hal/config/mapping.h"
#include "hal/description/body_section.h"
#include "hal/description/names.h"
#include "hal/description/routing_section.h"
#include "hal/hardware/robot_file_sections.h"

namespace hal::hardware {
namespace {

using config::Mapping;
using config::Option;

constexpr std::int64_t kLastAddress = 0xfffe;  // 0xffff is everyone

constexpr std::array kKinds = {Option<AgentKind>{"robot", AgentKind::kRobot},
                               Option<AgentKind>{"mote", AgentKind::kMote}};

void read_agent(Mapping in, RobotFile& file) {
  file.name = in.text("name");
  if (!file.name.empty() && !description::may_be_named(file.name)) {
    in.mistake("name",
               fmt::format("'{}' must be letters, digits, '_' and '-' after a letter", file.name));
  }
  // A mistaken address is nobody's: it must not seem to be taken by a landmark.
  if (!in.has("address")) in.mistake("address", "is missing");
  file.address = AgentId{static_cast<std::uint16_t>(in.integer("address", 1, kLastAddress, 0))};
  file.kind = in.choice("kind", kKinds).value_or(AgentKind::kMote);
  in.finish();
}

void read_controller(Mapping in, RobotFile& file) {
  if (in.has("program")) file.program = in.text("program");
  Mapping parameters = in.mapping("parameters");
  for (const config::Scalar& scalar : parameters.scalars()) {
    file.parameters.push_back({scalar.key, scalar.text, scalar.place});
  }
  in.finish();
}

RadioSettings read_radio(Mapping in, RadioPlaces& places) {
  RadioSettings radio;
  places = {in.place("interface"), in.place("address"), in.place("port")};
  radio.interface = in.text("interface");
  if (in.has("address")) radio.address = in.text("address");
  radio.port = static_cast<std::uint16_t>(in.integer("port", 1, 0xffff, radio.port));
  radio.bit_rate = in.number("bit_rate", "b/s", {1, 1e12}, radio.bit_rate);
  radio.power = in.number("power", "W", {0, 100}, radio.power);
  in.finish();
  return radio;
}

void read_times(Mapping& in, RobotFile& file) {
  file.seed = static_cast<std::uint64_t>(
      in.integer("seed", 0, std::numeric_limits<std::int64_t>::max(), 1));
  file.control_period = in.duration("control_period", {1e-3, 10}, file.control_period);
  file.command_timeout = in.duration("command_timeout", {1e-3, 3600}, file.command_timeout);
  if (file.command_timeout < file.control_period) {
    in.mistake("command_timeout",
               "must not be shorter than control_period: the wheels would stop between commands");
  }
}

/// A robot has a body and devices, a mote has neither.
void read_body(Mapping& in, RobotFile& file) {
  if (file.kind == AgentKind::kRobot) {
    file.robot = description::read_robot(in.mapping("robot"));
    read_devices(in, file);
    return;
  }
  for (const std::string key : {"robot", "wheels", "infrared", "limits", "on_lost_sensor"}) {
    in.refuse(key, "a mote has none");
  }
}

}  // namespace

RobotFile RobotFile::load(const std::filesystem::path& path,
                          const std::vector<std::string>& overrides) {
  auto document = config::Document::load(path, overrides);
  Mapping in = document.root();
  RobotFile file;
  in.integer("version", 1, 1);
  read_agent(in.mapping("agent"), file);
  read_controller(in.mapping("controller"), file);
  read_times(in, file);
  file.radio = read_radio(in.mapping("radio"), file.radio_places);
  file.routing =
      description::read_routing(in.mapping("routing"), description::TransmitStatus::kNone);
  file.localisation = read_localisation(in.mapping("localisation"), file);
  read_body(in, file);
  in.finish();
  document.finish();
  return file;
}

std::unique_ptr<PoseSource> make_static_pose(const RobotFile& file) {
  const Pose2* pose = std::get_if<Pose2>(&file.localisation.source);
  return pose == nullptr ? nullptr : std::make_unique<StaticPose>(*pose);
}

}  // namespace hal::hardware
