#include "sim/scenario/controller_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sim/scenario/fields.h"
#include "sim/scenario/override_agents.h"

namespace sim::scenario {
namespace {

using agents::AgentConfig;
using hal::node::exchange::ParameterText;

void set(std::vector<ParameterText>& parameters, const ParameterText& parameter) {
  const auto same = std::find_if(parameters.begin(), parameters.end(),
                                 [&](const auto& other) { return other.name == parameter.name; });
  if (same == parameters.end()) {
    parameters.push_back(parameter);
  } else {
    *same = parameter;
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

/// Writes the parameters whose names begin with `prefix`, which ends in a dot, as a mapping.
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

void parameters_key(Fields& io, const Key& key, std::vector<ParameterText>& parameters) {
  io.own(
      key, {.kind = hal::files::config::Form::Kind::kMapping},
      [&](Mapping& in) {
        for (hal::files::config::PlainValue& given : in.mapping(key).nested_values()) {
          parameters.push_back({std::move(given.key), std::move(given.text), std::move(given.place),
                                given.is_list, std::move(given.items)});
        }
      },
      [&](Writer& out) {
        out.open(key.name);
        write_values(out, parameters);
        out.close();
      });
}

/// @param is_given  whether the file gives the number of processes.
void check_processes(Fields& io, Group& group, std::size_t agents, bool is_given) {
  const int most = std::max(1, static_cast<int>(agents));
  if (group.processes > most) {
    io.mistake("processes", fmt::format("{} is above the limit of {}", group.processes, most));
  } else if (group.inside && is_given && group.processes < most) {
    io.mistake("processes",
               fmt::format("is {}, but with `inside` there is one for each of the {} agents",
                           group.processes, most));
  }
  group.processes = group.inside ? most : std::min(group.processes, most);
}

void process_keys(Fields& io, Group& group, std::span<const AgentConfig> agents) {
  io.count({"processes",
            "Number of controller processes that share the agents, at most one per agent; with "
            "`inside`, exactly one per agent.",
            "1"},
           1, hal::kLastAddress, group.processes);
  io.written_if(group.inside, [&](Fields& written) {
    written.flag({"inside",
                  "Whether the controller runs inside its agent's network, one process per agent, "
                  "where it may open its own sockets and DDS participants on wlan0.",
                  "true"},
                 group.inside);
  });
  if (io.reading() == nullptr) return;
  if (group.inside && !agents.empty() && !agents.front().network) {
    io.mistake("inside", "needs `network` of the group, the interface that it is for");
    group.inside = false;
  }
  check_processes(io, group, agents.size(), io.reading()->has("processes"));
}

/// Parameters for some of the agents.
struct Override {
  std::string agents;
  std::vector<ParameterText> parameters;
};

std::vector<Override> overrides_of(std::span<const AgentConfig> agents,
                                   const std::vector<ParameterText>& common) {
  std::vector<Override> overrides;
  for (const AgentConfig& agent : agents) {
    Override own{agent.name, agent.parameters};
    std::erase_if(own.parameters, [&](const ParameterText& one) { return contains(common, one); });
    if (!own.parameters.empty()) overrides.push_back(std::move(own));
  }
  return overrides;
}

void overrides_key(Fields& io, std::span<AgentConfig> agents,
                   const std::vector<ParameterText>& common) {
  std::vector<Override> overrides;
  if (io.reading() == nullptr) overrides = overrides_of(agents, common);
  OverrideAgents some(agents);
  io.list<Override>(
      {"overrides", "Parameters of some of the agents. No agent may be in two entries.",
       "[{agents: NAME0, parameters: {help_at: 1 s}}]"},
      overrides, [&](Fields& one, Override& c) {
        const std::vector<AgentConfig*> fitting = some.agents_key(one, c.agents);
        parameters_key(
            one, {"parameters", "Parameters with other values than the group's.", "{help_at: 1 s}"},
            c.parameters);
        for (AgentConfig* const agent : fitting) {
          for (const ParameterText& parameter : c.parameters) set(agent->parameters, parameter);
        }
      });
}

}  // namespace

void controller_keys(Fields& io, Group& group, std::span<AgentConfig> agents) {
  io.needed_text({"program",
                  "The controller: one that comes with BARAKA, one of yours in "
                  "BARAKA_CONTROLLER_PATH, or teleop.",
                  "help_mote"},
                 group.program);
  process_keys(io, group, agents);
  std::vector<ParameterText> common;
  if (io.reading() == nullptr && !agents.empty()) common = common_to(agents);
  parameters_key(io,
                 {"parameters",
                  "Parameters of the controller for all agents of the group; `baraka describe "
                  "PROGRAM` lists them.",
                  "{help_at: 1 s}"},
                 common);
  if (io.reading() != nullptr) {
    group.program_place = io.reading()->place("program");
    for (AgentConfig& agent : agents) {
      agent.program = group.program;
      agent.parameters = common;
      agent.inside = group.inside;
    }
  }
  overrides_key(io, agents, common);
}

}  // namespace sim::scenario
