#include "sim/scenario/agents_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "hal/files/config/suggest.h"
#include "hal/files/description/body_section.h"
#include "hal/files/description/robot_checks.h"
#include "hal/files/description/routing_section.h"
#include "hal/types/check.h"
#include "sim/scenario/controller_section.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/network_section.h"
#include "sim/scenario/placement.h"
#include "sim/scenario/programs_section.h"
#include "sim/scenario/station_radio_section.h"
#include "sim/scenario/station_section.h"
#include "sim/scenario/topics_section.h"

namespace sim::scenario {
namespace {

using agents::AgentConfig;
using hal::AgentId;
using hal::node::devices::MoteDescription;
using hal::node::devices::RobotDescription;
using hal::node::devices::WheelLevel;

using Algorithm = hal::node::routing::Algorithm;
using hal::kLastAddress;

/// Addresses and names already in use.
struct Taken {
  std::int64_t next = 1;
  std::set<AgentId> addresses;
  std::set<std::string> names;
};

constexpr std::array<Option<WheelLevel>, 2> kWheelLevels{
    {{"jointed", WheelLevel::kJointed}, {"contact", WheelLevel::kContact}}};

using Body = decltype(AgentConfig::body);

/// The keys of a robot or a mote.
template <class Kind>
void kind_keys(Fields& io, Kind& c) {
  keys_of(io, c);
}
void kind_keys(Fields& io, agents::Station& c) { station_keys(io, c); }

const std::array kBodies{
    alternative<Body, RobotDescription>({"robot",
                                         "The agents of the group are robots of this kind, usually "
                                         "{include: ../robots/robertino.yaml}."}),
    alternative<Body, MoteDescription>({"mote",
                                        "The agents of the group are motes of this kind, usually "
                                        "{include: ../robots/mote.yaml}."}),
    alternative<Body, agents::Station>(
        {"station",
         "The agents of the group are radio stations without bodies, which stand still or move "
         "along a path; controllers see them as motes."})};

/// An included group may have a body of another kind.
bool has_two_bodies(Mapping& in) {
  const std::vector<std::string> keys = in.keys();
  const auto is_there = [&](const auto& one) { return std::ranges::count(keys, one.key.name) > 0; };
  if (std::ranges::count_if(kBodies, is_there) < 2) return false;
  for (const auto& one : kBodies) in.has(one.key.name);
  return true;
}

/// A robot file describes the robot; the scenario says in how much detail wheels are simulated.
void body_keys(Fields& io, Body& body) {
  const bool are_two = io.reading() != nullptr && has_two_bodies(*io.reading());
  const auto keys = [](Fields& one, Body& any) {
    std::visit([&one](auto& c) { kind_keys(one, c); }, any);
  };
  if (are_two || !io.one_of(kBodies, body, keys))
    return io.mistake("", "must have either robot or mote or station");
  auto* const robot = std::get_if<RobotDescription>(&body);
  const std::string why =
      std::holds_alternative<MoteDescription>(body) ? "a mote has none" : "a station has none";
  io.only(robot != nullptr, {"robot", {"there"}}, why, [&](Fields& own) {
    WheelLevel level = robot == nullptr ? WheelLevel{} : robot->wheel_level;
    own.choice({"wheels",
                "How wheels are simulated. jointed: as bodies on hinges with motors; contact: only "
                "as forces where they touch the ground, some 3.5 times faster.",
                "jointed"},
               kWheelLevels, level);
    if (robot != nullptr) robot->wheel_level = level;
  });
}

void take_names(Mapping& in, const std::vector<std::string>& names, Taken& taken) {
  // Equal names within a group have been reported already.
  for (const std::string& name : std::set<std::string>(names.begin(), names.end())) {
    if (taken.names.insert(name).second) continue;
    in.mistake("name", fmt::format("the name '{}' is taken by another group", name));
    return;
  }
}

/// Assigns addresses to `count` agents, from `first` on.
std::vector<AgentId> take_addresses(Fields& io, std::int64_t first, std::size_t count,
                                    Taken& taken) {
  taken.next = first + static_cast<std::int64_t>(count);
  if (taken.next - 1 > hal::kLastAddress) {
    io.mistake("address", fmt::format("{} is above the limit of {} for the last of {} agents",
                                      taken.next - 1, hal::kLastAddress, count));
    taken.next = 1;
    return {};
  }
  std::vector<AgentId> addresses;
  addresses.reserve(count);
  bool clash = false;
  for (std::int64_t address = first; address < taken.next; ++address) {
    addresses.push_back(AgentId{static_cast<std::uint16_t>(address)});
    if (taken.addresses.insert(addresses.back()).second || clash) continue;
    clash = true;
    io.mistake("address", fmt::format("the address {} is taken by another group", address));
  }
  return addresses;
}

/// Returns "m{}" if the names are "m0", "m1", …
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

/// What determines the agents of a group.
struct Population {
  std::string names;
  std::int64_t address = 1;  ///< Address of the first agent.
  Body body = MoteDescription{};
  Placement placement;
};

Population population_of(std::span<const AgentConfig> agents) {
  std::vector<hal::Pose2> poses;
  poses.reserve(agents.size());
  for (const AgentConfig& agent : agents) poses.push_back(agent.pose);
  return {name_pattern(agents), agents.front().id.value, agents.front().body, std::move(poses)};
}

void keys_of(Fields& io, Population& c, Group& group) {
  name_key(io, c.names);
  io.count({"address",
            "Network address of the group's first agent; the other agents have the addresses that "
            "follow.",
            "1", "the first free one"},
           1, hal::kLastAddress, c.address);
  body_keys(io, c.body);
  placement_keys(io, c.placement, group.places);
}

/// Makes the agents of a group that is read.
std::vector<AgentConfig> populate(Fields& io, const Population& c, Group& group,
                                  const agents::SimulationConfig& config, Taken& taken) {
  Mapping& in = *io.reading();
  if (const auto* robot = std::get_if<RobotDescription>(&c.body)) {
    Mapping file = in.within("robot");
    hal::files::description::check_robot(file, *robot, config.world.gravity);
  }
  const std::vector<hal::Pose2> poses =
      poses_of(in, c.placement, config.seed, group.name, group.places);
  const std::vector<std::string> names = names_of(in, c.names, poses.size());
  take_names(in, names, taken);
  group.agents = take_addresses(io, c.address, poses.size(), taken);
  std::vector<AgentConfig> agents;
  agents.reserve(group.agents.size());
  for (std::size_t i = 0; i < group.agents.size(); ++i)
    agents.push_back({group.agents[i], names[i], poses[i], c.body, {}, {}, {}, {}, {}});
  return agents;
}

/// Robots and motes without a network need a controller; stations receive and relay without one.
void driver_keys(Fields& io, Group& group, std::span<AgentConfig> agents, const Body& body) {
  const bool is_networked = !agents.empty() && agents.front().network.has_value();
  const bool has_network =
      io.inside_given({"network",
                       "Network interface `wlan0` for programs with sockets: their packets go "
                       "through the agents' simulated radios. Such a run is in lock-step, unless "
                       "`--pace` says otherwise."},
                      is_networked, [&](Fields& network) { network_keys(network, group, agents); });
  io.only(has_network, {"network", {"there"}}, "needs `network`, the interface that programs use",
          [&](Fields& networked) {
            programs_keys(networked, group);
            topics_keys(networked, group);
          });
  const Key key{
      "controller",
      "The controller of the agents. Stations, and agents with a network, can do without."};
  const auto controller = [&](Fields& one) { controller_keys(one, group, agents); };
  const bool may_be_absent = has_network || std::holds_alternative<agents::Station>(body);
  if (io.is_writing() || may_be_absent) {
    io.inside_given(key, !group.program.empty(), controller);
  } else {
    io.inside(key, controller);
  }
}

/// The remaining keys for a group's agents.
void other_keys(Fields& io, std::span<AgentConfig> agents) {
  bool is_present = agents.empty() || agents.front().is_present;
  std::optional<Algorithm> routing;
  if (!agents.empty()) routing = agents.front().routing;
  io.written_if(!is_present, [&](Fields& absent) {
    absent.flag(
        {"present",
         "Whether the group's agents are present at the start; if not, an event can add them.",
         "false"},
        is_present);
  });
  const Key key{
      "routing",
      "Routing protocol of the group's messages, with the keys of the scenario's `routing`; or "
      "`none`: no routing, messages go directly to the MAC and travel one hop.",
      "none", "that of the scenario"};
  if (io.is_writing()) {  // includes algorithms that files cannot name
    std::string name(routing ? routing->name() : "");
    io.given_text(key, name);
  } else {
    io.given_choice(key, hal::files::description::routing_algorithms(), routing);
  }
  for (AgentConfig& agent : agents) {
    agent.is_present = is_present;
    agent.routing = routing;
  }
}

/// @param agents  of the group; filled in when reading.
void keys_of(Fields& io, Group& group, std::vector<AgentConfig>& agents,
             const agents::SimulationConfig& config, Taken& taken) {
  Population population{.names = group.name + "{}", .address = taken.next, .placement = {}};
  if (io.is_writing()) population = population_of(agents);
  keys_of(io, population, group);
  if (io.reading() != nullptr) agents = populate(io, population, group, config, taken);
  driver_keys(io, group, agents, population.body);
  station_radio_key(io, agents, config.radio);
  other_keys(io, agents);
}

/// Whether only the command line names the group: it was probably meant to change one of the file's
/// groups.
bool is_reached_for(Mapping& in) {
  return in.place().starts_with("--set") && !in.has("robot") && !in.has("mote") &&
         !in.has("station");
}

void read_group(Fields& io, const std::string& name, Scenario& scenario, Taken& taken) {
  Group group{.name = name, .agents = {}, .places = {}, .program = {}, .program_place = {}};
  std::vector<AgentConfig> agents;
  keys_of(io, group, agents, scenario.simulation, taken);
  auto& all = scenario.simulation.agents;
  all.insert(all.end(), agents.begin(), agents.end());
  scenario.groups.push_back(std::move(group));
}

void write_group(Fields& io, Group group, const agents::SimulationConfig& config) {
  const auto first = std::ranges::find(config.agents, group.agents.front(), &AgentConfig::id);
  BARAKA_CHECK(first != config.agents.end());
  std::vector<AgentConfig> agents(first, first + static_cast<std::ptrdiff_t>(group.agents.size()));
  Taken none;
  keys_of(io, group, agents, config, none);
}

void group_keys(Fields& io, Scenario& scenario) {
  std::vector<std::string> names;
  for (const Group& group : scenario.groups) names.push_back(group.name);
  if (io.reading() != nullptr) names = io.reading()->keys();
  if (names.empty()) io.mistake("", "there must be at least one group of agents");
  Taken taken;
  io.named({"NAME",
            "A group of agents with the same kind of body and the same controller, under a name of "
            "your own."},
           names, [&](Fields& one, const std::string& name) {
             Mapping* const in = one.reading();
             if (one.is_writing()) {
               write_group(one, *std::ranges::find(scenario.groups, name, &Group::name),
                           scenario.simulation);
             } else if (in == nullptr || !is_reached_for(*in)) {
               read_group(one, name, scenario, taken);
             } else {
               std::vector<std::string> others = names;
               std::erase(others, name);
               in->mistake(
                   "", "is not the name of a group" + hal::files::config::suggestion(name, others));
               in->leave_rest();
             }
           });
  if (io.is_writing()) return;
  std::ranges::sort(scenario.simulation.agents, {}, &AgentConfig::id);
}

}  // namespace

void agents_key(Fields& io, Scenario& scenario) {
  io.inside({"agents", "Groups of agents, each under a name of its own (here NAME); at least one."},
            [&](Fields& groups) { group_keys(groups, scenario); });
}

}  // namespace sim::scenario
