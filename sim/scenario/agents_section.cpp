#include "sim/scenario/agents_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string>

#include "hal/config/suggest.h"
#include "hal/description/body_section.h"
#include "hal/description/routing_section.h"
#include "hal/types/check.h"
#include "sim/scenario/controller_section.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/network_section.h"
#include "sim/scenario/placement.h"
#include "sim/scenario/programs_section.h"
#include "sim/scenario/station_radio_section.h"
#include "sim/scenario/station_section.h"

namespace sim::scenario {
namespace {

using agents::AgentConfig;
using hal::AgentId;
using hal::description::read_mote;
using hal::description::read_robot;
using hal::description::write_mote;
using hal::description::write_robot;
using hal::devices::MoteDescription;
using hal::devices::RobotDescription;
using hal::devices::WheelLevel;

const Key kRobot{
    "robot",
    "The group's agents are robots of this kind, mostly {include: ../robots/robertino.yaml}."};

const Key kWheels{
    "wheels",
    "How much of the wheels is simulated: bodies on hinges with motors, or only where "
    "they touch the ground, which is some 3.5 times faster.",
    "jointed"};

const Key kStation{
    "station",
    "The group's agents are radios without bodies, which stand or move on a path; to "
    "their controllers they are motes."};

const Key kPresent{"present",
                   "Whether the group's agents are there at the start; if not, an event may add "
                   "them.",
                   "false"};

using Algorithm = hal::routing::Algorithm;
const Key kRouting{"routing",
                   "How the group's messages find their way: by this algorithm, with the keys of "
                   "the scenario's `routing`, or `none`: straight to the MAC, one hop.",
                   "none", "that of the scenario"};

using hal::kLastAddress;

/// Addresses and names given away so far.
struct Taken {
  std::int64_t next = 1;
  std::set<AgentId> addresses;
  std::set<std::string> names;
};

constexpr std::array<Option<WheelLevel>, 2> kWheelLevels{
    {{"jointed", WheelLevel::kJointed}, {"contact", WheelLevel::kContact}}};

/// A robot file says what a robot is; how much of its wheels is simulated, the scenario says.
RobotDescription read_robot_group(Mapping& in, double gravity) {
  RobotDescription robot = read_robot(in.mapping(kRobot), gravity);
  robot.wheel_level = in.choice(kWheels, kWheelLevels, robot.wheel_level);
  return robot;
}

MoteDescription read_mote_group(Mapping& in) {
  in.refuse("wheels", "a mote has none");
  return read_mote(in.mapping(
      {"mote",
       "The group's agents are motes of this kind, mostly {include: ../robots/mote.yaml}."}));
}

sim::agents::Station read_station_group(Mapping& in) {
  in.refuse("wheels", "a station has none");
  return read_station_body(in.mapping(kStation));
}

/// @param gravity  m/s^2, of the scenario's world.
auto read_body(Mapping& in, double gravity) -> decltype(AgentConfig::body) {
  constexpr const char* kOneOfThem = "must have either robot or mote or station";
  int bodies = 0;
  for (const std::string& key : in.keys()) {
    bodies += key == "robot" || key == "mote" || key == "station" ? 1 : 0;
  }
  if (bodies > 1) {
    in.mistake("", kOneOfThem);
    for (const char* body : {"robot", "mote", "station"}) in.has(body);
    return MoteDescription{};
  }
  if (in.has("robot")) return read_robot_group(in, gravity);
  if (in.has("mote")) return read_mote_group(in);
  if (in.has("station")) return read_station_group(in);
  in.mistake("", kOneOfThem);
  return MoteDescription{};
}

void take_names(Mapping& in, const std::vector<std::string>& names, Taken& taken) {
  // That a group calls all its agents the same has been said.
  for (const std::string& name : std::set<std::string>(names.begin(), names.end())) {
    if (taken.names.insert(name).second) continue;
    in.mistake("name", fmt::format("the name '{}' is taken by another group", name));
    return;
  }
}

/// Addresses for `count` agents, from `address` or the first free one.
std::vector<AgentId> take_addresses(Mapping& in, std::size_t count, Taken& taken) {
  const std::int64_t first =
      in.integer({"address", "Network address of the group's first agent; the others count on.",
                  "1", "the first free one"},
                 1, kLastAddress, taken.next);
  taken.next = first + static_cast<std::int64_t>(count);
  if (taken.next - 1 > kLastAddress) {
    in.mistake("address", fmt::format("{} is above the limit of {} for the last of {} agents",
                                      taken.next - 1, kLastAddress, count));
    taken.next = 1;
    return {};
  }
  std::vector<AgentId> addresses;
  bool clash = false;
  for (std::int64_t address = first; address < taken.next; ++address) {
    addresses.push_back(AgentId{static_cast<std::uint16_t>(address)});
    if (taken.addresses.insert(addresses.back()).second || clash) continue;
    clash = true;
    in.mistake("address", fmt::format("the address {} is taken by another group", address));
  }
  return addresses;
}

/// Robots and motes without a network must be driven by somebody; stations hear and relay alone.
void read_who_drives(Mapping& in, Group& group, std::vector<AgentConfig>& agents) {
  const bool has_network = in.has("network");
  if (has_network) {
    read_network(in.mapping({"network",
                             "An interface `wlan0` for programs with sockets: their packets go "
                             "through the agents' simulated radios. Such a run is in real time."}),
                 agents);
    read_programs(in, group);
  } else {
    in.refuse("programs", "needs `network`, the interface that programs use");
  }
  if ((has_network || in.has("station")) && !in.has("controller")) return;
  read_controller(in.mapping({"controller",
                              "The program that drives the agents; may be absent of stations, and "
                              "where they have a network."}),
                  group, agents);
}

void read_group(const std::string& name, Mapping in, Scenario& scenario, Taken& taken) {
  Group group{.name = name, .agents = {}, .places = {}, .program = {}, .program_place = {}};
  const auto body = read_body(in, scenario.simulation.world.gravity);
  const std::vector<hal::Pose2> poses =
      read_poses(in, scenario.simulation.seed, name, group.places);
  const std::vector<std::string> names = read_names(in, name, poses.size());
  take_names(in, names, taken);
  group.agents = take_addresses(in, poses.size(), taken);
  std::vector<AgentConfig> agents;
  for (std::size_t i = 0; i < group.agents.size(); ++i) {
    agents.push_back({group.agents[i], names[i], poses[i], body, {}, {}, {}, {}, {}});
  }
  read_who_drives(in, group, agents);
  read_station_radios(
      in.mapping({"radio", "What the radios of the group's agents have of their own."}),
      scenario.simulation.radio, agents);
  const bool is_present = in.flag(kPresent, true);
  for (AgentConfig& agent : agents) agent.is_present = is_present;
  const bool has_routing = in.has(kRouting.name);
  const Algorithm routing = in.choice(kRouting, hal::description::kRoutingAlgorithms,
                                      scenario.simulation.routing.algorithm);
  for (AgentConfig& agent : agents) {
    if (has_routing) agent.routing = routing;
  }
  in.finish();
  auto& all = scenario.simulation.agents;
  all.insert(all.end(), agents.begin(), agents.end());
  scenario.groups.push_back(std::move(group));
}

/// A group that only the command line names: it meant to change one of the file's.
bool is_reached_for(Mapping& in) {
  return in.place().starts_with("--set") && !in.has("robot") && !in.has("mote") &&
         !in.has("station");
}

/// "m{}" if the names are "m0", "m1", …
std::string name_pattern(std::span<const AgentConfig> agents) {
  const std::string& first = agents.front().name;
  if (agents.size() == 1) return first;
  for (std::size_t hole = first.find('0'); hole != std::string::npos;
       hole = first.find('0', hole + 1)) {
    std::string second = first;
    second[hole] = '1';
    if (second != agents[1].name) continue;
    std::string pattern = first;
    return pattern.replace(hole, 1, "{}");
  }
  return first;
}

void write_group(Writer& out, const Group& group, std::span<const AgentConfig> agents) {
  out.open(group.name);
  out.text("name", name_pattern(agents));
  out.integer("address", agents.front().id.value);
  if (const auto* robot = std::get_if<RobotDescription>(&agents.front().body)) {
    FieldWriter(out).choice(kWheels, kWheelLevels, robot->wheel_level);
    write_robot(out, *robot);
  } else if (const auto* mote = std::get_if<MoteDescription>(&agents.front().body)) {
    write_mote(out, *mote);
  } else {
    write_station_body(out, std::get<sim::agents::Station>(agents.front().body));
  }
  out.open_list("poses");
  for (const AgentConfig& agent : agents) {
    out.open_item();
    out.number("x", agent.pose.x, "m");
    out.number("y", agent.pose.y, "m");
    out.number("yaw", agent.pose.theta, "rad");
    out.close();
  }
  out.close();
  if (!group.program.empty()) write_controller(out, group, agents);
  write_network(out, agents);
  write_programs(out, group);
  write_station_radios(out, agents);
  if (!agents.front().is_present) out.flag(kPresent.name, false);
  if (agents.front().routing) out.text(kRouting.name, agents.front().routing->name());
  out.close();
}

}  // namespace

void read_agents(Mapping in, Scenario& scenario) {
  Taken taken;
  const std::vector<std::string> names = in.keys();
  if (names.empty()) in.mistake("", "there must be at least one group of agents");
  for (const std::string& name : names) {
    Mapping group = in.mapping(
        {name,
         "A group of agents with one kind of body and one controller, under a name of your own."});
    if (is_reached_for(group)) {
      std::vector<std::string> others = names;
      std::erase(others, name);
      in.mistake(name, "is not the name of a group" + hal::config::suggestion(name, others));
    } else {
      read_group(name, group, scenario, taken);
    }
  }
  in.finish();
  std::sort(scenario.simulation.agents.begin(), scenario.simulation.agents.end(),
            [](const AgentConfig& a, const AgentConfig& b) { return a.id < b.id; });
}

void write_agents(Writer& out, const Scenario& scenario) {
  const std::vector<AgentConfig>& all = scenario.simulation.agents;
  out.open("agents");
  for (const Group& group : scenario.groups) {
    const auto first = std::find_if(all.begin(), all.end(), [&](const AgentConfig& agent) {
      return agent.id == group.agents.front();
    });
    BARAKA_CHECK(first != all.end());
    write_group(out, group, {&*first, group.agents.size()});
  }
  out.close();
}

}  // namespace sim::scenario
