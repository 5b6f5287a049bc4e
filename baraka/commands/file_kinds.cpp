#include "baraka/commands/file_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "baraka/campaign/check_campaign.h"
#include "baraka/fleet/fleet_command.h"
#include "baraka/run/check/check_scenario.h"
#include "gateway/server/kind_of_file.h"
#include "hal/files/config/document.h"
#include "hal/files/config/errors.h"
#include "hal/files/description/body_section.h"
#include "hal/files/description/key_describer.h"
#include "hal/robot/agent/robot_file.h"
#include "hal/types/terminal_colours.h"
#include "results/fleet/fleet_file.h"
#include "sim/scenario/radio_section.h"
#include "sim/scenario/scenario.h"

namespace baraka::commands {
namespace {

using hal::files::config::Document;
using hal::files::config::Mapping;
using hal::files::description::Fields;
using hal::node::devices::MoteDescription;
using hal::node::devices::RobotDescription;
using Overrides = std::vector<std::string>;

void check_scenario(const std::string& path, const Overrides& overrides,
                    const run::check::RunMode& mode) {
  (void)run::check::load_checked(path, overrides, mode);
}
void tell(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) hal::print_line(hal::Tone::kWarning, warning);
}

void check_campaign(const std::string& path, const Overrides& overrides,
                    const run::check::RunMode&) {
  tell(campaign::check_campaign(path, overrides).warnings);
}

void check_fleet(const std::string& path, const Overrides& overrides, const run::check::RunMode&) {
  tell(fleet::check_fleet(path, overrides));
}

void check_hardware(const std::string& path, const Overrides& overrides,
                    const run::check::RunMode&) {
  tell(hal::robot::agent::RobotFile::load(path, overrides).warnings);
}
void read_robot(Mapping in) { hal::files::description::read_robot(std::move(in)); }
void read_mote(Mapping in) { hal::files::description::read_mote(std::move(in)); }
void read_radio(Mapping in) { sim::scenario::read_radio(std::move(in)); }

template <class File>
void describe(Fields& io) {
  using sim::scenario::keys_of;
  File file;
  keys_of(io, file);
}

/// Checks a kind of file by just reading it.
template <void (*kRead)(Mapping)>
void check_file(const std::string& path, const Overrides& overrides, const run::check::RunMode&) {
  Document document = Document::load(path, overrides);
  kRead(document.root());
  document.finish();
  tell(document.warnings());
}

constexpr const char* kScenario = R"(version: 1
name: my_scenario
radio: {profile: ieee80211b}
agents:
  motes:
    name: m{}
    mote: {include: robots/mote.yaml}        # of those that come with BARAKA
    grid: {columns: 3, rows: 1, spacing: [50 m, 50 m]}
    controller:
      program: help_mote
      overrides:
        - {agents: m2, parameters: {help_at: 1 s}}
  robots:
    name: r{}
    robot: {include: robots/robertino.yaml}
    poses:
      - {x: 3 m, y: 3 m, yaw: 90 deg}
    controller: {program: help_robot, parameters: {speed: 0.5 m/s}}
end:
  - {agent: m2, state: FULFILLED, after: 1 s, result: arrived}
  - {at: 600 s, result: timeout}
expect:
  - {result: arrived}
)";

constexpr const char* kCampaign = R"(version: 1
name: speeds
scenario: scenarios/case_study.yaml
replications: 5
vary:
  agents.robots.controller.parameters.speed: [0.3 m/s, 0.6 m/s]
  radio.profile: [mobility_framework, ideal]
keep: failed
)";

constexpr const char* kFleet = R"(version: 1
name: warehouse
scenario: fleet_on_an_access_point
robots: {group: robots, from: 2, to: 12, step: 2}
radios:
  g: {radio: {include: radios/ieee80211g.yaml, bss: {access_point: ap}}}
  ac: {radio: {include: radios/ieee80211ac.yaml, bss: {access_point: ap}}}
profiles:
  default: {vendor: cyclonedds}
  one_frame: {vendor: cyclonedds, file: cyclone_one_frame.xml}
need:
  - {topic: "*/scan", delivered: 99 %, p95: 50 ms}
  - {topic: "*/odom", delivered: 99.9 %, age: 200 ms}
)";

constexpr const char* kHardware = R"(version: 1
agent: {name: r0, address: 26, kind: robot}
controller: {program: help_robot, parameters: {speed: 0.5 m/s}}
radio: {interface: wlan0, port: 7300}
localisation: {driver: pose_topic, topic: /mocap/r0/pose}
robot: {include: robots/robotino.yaml}
wheels: {driver: robotino_rest, host: 192.168.0.1}
infrared: {driver: robotino_rest, host: 192.168.0.1}
limits: {linear: 0.6 m/s, angular: 1.5 rad/s}
)";

constexpr const char* kRobot = R"(version: 1
model: cart
link:
  collision:
    - {cylinder: {radius: 18 cm, bottom: 2 cm, top: 21 cm}, mass: 9 kg}
wheels:
  wheel: {radius: 4 cm, mass: 200 g, limit: {effort: 1 N m, velocity: 23 rad/s}}
  joints:
    - {distance: 13 cm, bearing: 60 deg}
    - {distance: 13 cm, bearing: 180 deg}
    - {distance: 13 cm, bearing: 300 deg}
)";

constexpr const char* kMote = R"(version: 1
model: cube
size: [5 cm, 5 cm, 5 cm]
mass: 50 g
)";

constexpr const char* kRadio = R"(version: 1
profile: disk
range: 100 m
data_rate: 1 Mb/s
)";

/// Number of a file's top-level keys that a kind knows.
std::size_t known(const FileKind& kind, const std::vector<std::string>& keys) {
  const auto& of_kind = keys_of(kind);
  return static_cast<std::size_t>(std::ranges::count_if(keys, [&](const std::string& key) {
    return std::ranges::count(of_kind, key, &hal::files::config::KeyDescription::path) > 0;
  }));
}

}  // namespace

const std::vector<FileKind>& file_kinds() {
  static const std::vector<FileKind> kinds = {
      {"scenario", "What `baraka run` runs: a world, a radio, agents and their controllers.",
       gateway::server::use_of("scenario"), kScenario, check_scenario,
       describe<sim::scenario::Scenario>},
      {"campaign",
       "What `baraka campaign` runs: a scenario many times, over the values of its keys.",
       gateway::server::use_of("campaign"), kCampaign, check_campaign,
       describe<results::campaign::CampaignFile>},
      {"fleet",
       "What `baraka fleet` answers: with how many robots the topics of a fleet still arrive.",
       gateway::server::use_of("fleet"), kFleet, check_fleet, describe<results::fleet::FleetFile>},
      {"hardware", "A real robot or mote: what `baraka-agentd` drives.",
       gateway::server::use_of("hardware"), kHardware, check_hardware,
       describe<hal::robot::agent::RobotFile>},
      {"robot",
       "Body, wheels and sensors of a kind of robot, simulated or real; included by scenarios and "
       "hardware files.",
       gateway::server::use_of("robot"), kRobot, check_file<read_robot>,
       describe<RobotDescription>},
      {"mote", "Body of a kind of mote; included by scenarios.", gateway::server::use_of("mote"),
       kMote, check_file<read_mote>, describe<MoteDescription>},
      {"radio", "A radio; included by scenarios.", gateway::server::use_of("radio"), kRadio,
       check_file<read_radio>, describe<sim::radio::RadioConfig>}};
  return kinds;
}

const std::vector<hal::files::config::KeyDescription>& keys_of(const FileKind& kind) {
  static std::map<std::string, std::vector<hal::files::config::KeyDescription>> tables;
  const auto [found, is_new] = tables.try_emplace(kind.name);
  if (is_new) {
    hal::files::description::KeyDescriber describer;
    kind.keys(describer);
    found->second = describer.keys();
  }
  return found->second;
}

const FileKind& recognised(const std::string& path, const std::vector<std::string>& overrides) {
  const std::vector<std::string> keys = Document::load(path, overrides).root().keys();
  std::vector<const FileKind*> best;
  std::size_t most = 0;
  for (const FileKind& kind : file_kinds()) {
    const std::size_t count = known(kind, keys);
    if (count > most) best.clear();
    if (count >= most) best.push_back(&kind);
    most = std::max(most, count);
  }
  // Many keys are common to campaigns and fleets; only fleets need something.
  if (std::ranges::find(keys, "need") == keys.end() && best.size() > 1) {
    std::erase_if(best, [](const FileKind* kind) { return kind->name == "fleet"; });
  }
  if (best.size() == 1) return *best.front();
  std::vector<std::string> names;
  names.reserve(best.size());
  for (const FileKind* kind : best) names.push_back(kind->name);
  if (keys.empty()) {
    throw hal::files::config::ConfigErrors(
        {fmt::format("{}: is empty: it has no key of any kind of file; `baraka describe scenario` "
                     "shows a scenario",
                     path)});
  }
  throw hal::files::config::ConfigErrors(
      {fmt::format("{}:1:1: may be a file of the kinds {}: it has {}; say which by --kind", path,
                   fmt::join(names, ", "), most == 0 ? "no key of any" : "as many keys of each")});
}

}  // namespace baraka::commands
