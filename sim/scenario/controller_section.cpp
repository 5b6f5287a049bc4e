#include "sim/scenario/controller_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sim/scenario/fields.h"
#include "sim/scenario/override_agents.h"

namespace sim::scenario {
namespace {

using agents::AgentConfig;
using hal::exchange::ParameterText;

std::vector<ParameterText> read_parameters(Mapping in) {
  std::vector<ParameterText> parameters;
  for (hal::config::PlainValue& given : in.nested_values()) {
    parameters.push_back({std::move(given.key), std::move(given.text), std::move(given.place),
                          given.is_list, std::move(given.items)});
  }
  return parameters;
}

void set(std::vector<ParameterText>& parameters, const ParameterText& parameter) {
  const auto same = std::find_if(parameters.begin(), parameters.end(),
                                 [&](const auto& other) { return other.name == parameter.name; });
  if (same == parameters.end()) {
    parameters.push_back(parameter);
  } else {
    *same = parameter;
  }
}

void apply_override(Mapping& in, OverrideAgents& some) {
  const std::vector<AgentConfig*> fitting = some.read(in);
  const std::vector<ParameterText> parameters =
      read_parameters(in.mapping({"parameters", "Those in which they differ.", "{help_at: 1 s}"}));
  in.finish();
  for (AgentConfig* const agent : fitting) {
    for (const ParameterText& parameter : parameters) set(agent->parameters, parameter);
  }
}

bool contains(const std::vector<ParameterText>& parameters, const ParameterText& parameter) {
  return std::ranges::any_of(parameters, [&](const ParameterText& other) {
    return other.name == parameter.name && other.value == parameter.value &&
           other.is_list == parameter.is_list && other.items == parameter.items;
  });
}

/// The parameters that all agents share.
std::vector<ParameterText> common_to(std::span<const AgentConfig> agents) {
  std::vector<ParameterText> common = agents.front().parameters;
  std::erase_if(common, [&](const ParameterText& parameter) {
    return std::ranges::any_of(
        agents, [&](const AgentConfig& agent) { return !contains(agent.parameters, parameter); });
  });
  return common;
}

void write_values(Writer& out, const std::vector<ParameterText>& parameters);

/// The parameters whose names begin with `prefix`, which ends in a dot, as a mapping.
void write_mapping(Writer& out, const std::vector<ParameterText>& parameters,
                   const std::string& prefix) {
  std::vector<ParameterText> inner;
  for (const ParameterText& parameter : parameters) {
    if (!parameter.name.starts_with(prefix)) continue;
    inner.push_back(parameter);
    inner.back().name.erase(0, prefix.size());
  }
  out.open(std::string_view(prefix).substr(0, prefix.size() - 1));
  write_values(out, inner);
  out.close();
}

void write_values(Writer& out, const std::vector<ParameterText>& parameters) {
  std::set<std::string> mappings;
  for (const ParameterText& parameter : parameters) {
    const auto dot = parameter.name.find('.');
    if (dot != std::string::npos) {
      const std::string prefix = parameter.name.substr(0, dot + 1);
      if (mappings.insert(prefix).second) write_mapping(out, parameters, prefix);
    } else if (parameter.is_list) {
      out.texts(parameter.name, parameter.items);
    } else {
      out.text(parameter.name, parameter.value);
    }
  }
}

void write_parameters(Writer& out, const std::vector<ParameterText>& parameters) {
  out.open("parameters");
  write_values(out, parameters);
  out.close();
}

const Key kProcesses{"processes",
                     "Controller processes that share the agents; at most one for each, and one "
                     "for each with `inside`.",
                     "1"};

/// Those that share `agents` agents.
int read_processes(Mapping& in, std::size_t agents, bool inside) {
  const auto most = std::max<std::int64_t>(1, static_cast<std::int64_t>(agents));
  const bool is_given = in.has(kProcesses.name);
  const std::int64_t processes = in.integer(kProcesses, 1, hal::kLastAddress, 1);
  if (processes > most) {
    in.mistake(kProcesses.name, fmt::format("{} is above the limit of {}", processes, most));
  }
  if (!inside) return static_cast<int>(std::min(processes, most));
  if (is_given && processes < most) {
    in.mistake(kProcesses.name,
               fmt::format("is {}, but with `inside` there is one for each of the {} agents",
                           processes, most));
  }
  return static_cast<int>(most);
}

bool read_inside(Mapping& in, std::span<const AgentConfig> agents) {
  const bool inside = in.flag(
      {"inside",
       "Whether the controller runs inside its agent's network, where it may open sockets and DDS "
       "participants of its own on wlan0; one process for each agent.",
       "true"},
      false);
  if (!inside) return false;
  if (agents.empty() || agents.front().network) return true;
  in.mistake("inside", "needs `network` of the group, the interface that it is for");
  return false;
}

}  // namespace

void read_controller(Mapping in, Group& group, std::span<AgentConfig> agents) {
  group.program = in.text(
      {"program", "The controller: one of ours, one of yours in BARAKA_CONTROLLER_PATH, or teleop.",
       "help_mote"});
  group.program_place = in.place("program");
  group.inside = read_inside(in, agents);
  group.processes = read_processes(in, agents.size(), group.inside);
  const std::vector<ParameterText> parameters = read_parameters(in.mapping(
      {"parameters", "Of the controller, for all agents; `baraka describe PROGRAM` shows them.",
       "{help_at: 1 s}"}));
  for (AgentConfig& agent : agents) {
    agent.program = group.program;
    agent.parameters = parameters;
    agent.inside = group.inside;
  }
  OverrideAgents some(agents);
  for (Mapping& one :
       in.mappings({"overrides", "Parameters for some of the agents; no agent twice.",
                    "[{agents: NAME0, parameters: {help_at: 1 s}}]"}))
    apply_override(one, some);
  in.finish();
}

void write_controller(Writer& out, const Group& group, std::span<const AgentConfig> agents) {
  out.open("controller");
  out.text("program", group.program);
  out.integer("processes", group.processes);
  if (group.inside) out.flag("inside", true);
  const std::vector<ParameterText> common = common_to(agents);
  write_parameters(out, common);
  out.open_list("overrides");
  for (const AgentConfig& agent : agents) {
    std::vector<ParameterText> own = agent.parameters;
    std::erase_if(own, [&](const ParameterText& one) { return contains(common, one); });
    if (own.empty()) continue;
    out.open_item();
    out.text("agents", agent.name);
    write_parameters(out, own);
    out.close();
  }
  out.close();
  out.close();
}

}  // namespace sim::scenario
