#include "gateway/run/judge_controllers.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <variant>

#include "gateway/find_program.h"
#include "gateway/teleop_port.h"
#include "hal/config/errors.h"
#include "hal/config/shared_folders.h"
#include "hal/config/suggest.h"
#include "hal/exchange/ports.h"
#include "hal/runtime/check_parameters.h"
#include "hal/runtime/plugin.h"
#include "sim/agents/agent_offer.h"

namespace gateway {
namespace {

const sim::agents::AgentConfig& config_of(const sim::scenario::Scenario& scenario,
                                          hal::AgentId id) {
  const auto& agents = scenario.simulation.agents;
  return *std::ranges::lower_bound(agents, id, {}, &sim::agents::AgentConfig::id);  // by address
}

bool drives(const hal::ControllerKind& kind, const sim::agents::AgentConfig& agent) {
  return is_robot(agent) ? kind.make_for_robot != nullptr : kind.make_for_mote != nullptr;
}

void judge_group(const sim::scenario::Scenario& scenario, const sim::scenario::Group& group,
                 const hal::ControllerKind& kind, std::vector<std::string>& mistakes) {
  std::set<std::string> said;  // agents of a group share their parameters: say each mistake once
  for (const hal::AgentId id : group.agents) {
    const sim::agents::AgentConfig& agent = config_of(scenario, id);
    if (!drives(kind, agent) && said.insert(group.program_place).second) {
      mistakes.push_back(fmt::format("{}: program: '{}' does not drive agents like {}",
                                     group.program_place, group.program, agent.name));
    }
    for (std::string& mistake : hal::runtime::check_parameters(kind, agent.parameters)) {
      if (said.insert(mistake).second) mistakes.push_back(std::move(mistake));
    }
  }
}

/// Whether each agent offers what the controller cannot do without.
void judge_channels(const sim::scenario::Scenario& scenario, const sim::scenario::Group& group,
                    const hal::ControllerKind& kind, std::vector<std::string>& mistakes) {
  for (const hal::AgentId id : group.agents) {
    const sim::agents::AgentConfig& agent = config_of(scenario, id);
    if (!drives(kind, agent)) continue;
    const auto offer = sim::agents::offer_of(agent, scenario.simulation);
    const auto session = hal::exchange::session_for(offer, kind.wants);
    if (session) continue;
    mistakes.push_back(fmt::format("{}: program: '{}' cannot do without a channel: {}",
                                   group.program_place, group.program, session.error().message));
    return;  // the others have the same body
  }
}

/// A state of agents' controllers that a scenario waits for or asks about.
struct AwaitedState {
  std::string place;  ///< "file:line:column".
  std::string_view key;
  std::vector<hal::AgentId> agents;
  std::string state;
};

std::vector<AwaitedState> awaited_states(const sim::scenario::Scenario& scenario) {
  std::vector<AwaitedState> awaited;
  for (std::size_t i = 0; i < scenario.simulation.ends.size(); ++i) {
    const sim::agents::EndCondition& end = scenario.simulation.ends[i];
    if (end.agent)
      awaited.push_back({scenario.state_places[i], "end.state", {*end.agent}, end.state});
  }
  for (const sim::scenario::Expectation& expectation : scenario.expectations) {
    const auto* distance = std::get_if<sim::scenario::ExpectedDistance>(&expectation.condition);
    if (distance == nullptr || distance->entered.empty()) continue;
    awaited.push_back({expectation.place, "expect.entered", distance->which, distance->entered});
  }
  return awaited;
}

/// Whether the controller enters the states that are awaited of this group's agents alone.
void judge_states(const sim::scenario::Scenario& scenario, const sim::scenario::Group& group,
                  std::string_view program, const std::vector<std::string>& states,
                  ControllerJudgement& judgement) {
  const auto is_of_group = [&](hal::AgentId id) {
    return std::ranges::find(group.agents, id) != group.agents.end();
  };
  bool unknown = false;
  for (const AwaitedState& awaited : awaited_states(scenario)) {
    if (!std::ranges::all_of(awaited.agents, is_of_group)) continue;
    if (states.empty()) unknown = true;
    if (states.empty() || std::ranges::find(states, awaited.state) != states.end()) continue;
    judgement.mistakes.push_back(fmt::format("{}: {}: {} declares no state '{}'{}", awaited.place,
                                             awaited.key, program, awaited.state,
                                             hal::config::suggestion(awaited.state, states)));
  }
  if (unknown) {
    judgement.not_checked.push_back(
        fmt::format("states of {}: not checked, it declares none", program));
  }
}

std::vector<std::string> names_of(const std::vector<hal::RecordSpec>& records) {
  std::vector<std::string> names;
  names.reserve(records.size());
  for (const hal::RecordSpec& record : records) names.push_back(record.name);
  return names;
}

/// What is known of what the controllers of the agents of a pattern record.
struct DeclaredRecords {
  std::vector<std::string> names{};
  bool has_match = false;
  bool has_unknown = false;  ///< One of them does not declare what it records.
};

/// @param kinds  by controller; without those whose plug-in is not there.
DeclaredRecords declared_records(const sim::scenario::Scenario& scenario,
                                 const sim::record::ObservablePattern& pattern,
                                 const std::map<std::string, const hal::ControllerKind*>& kinds) {
  DeclaredRecords declared;
  std::set<std::string> seen;
  for (const sim::agents::AgentConfig& agent : scenario.simulation.agents) {
    if (!pattern.has_agent(agent.name) || !seen.insert(agent.program).second) continue;
    const auto kind = kinds.find(agent.program);
    if (kind == kinds.end() || kind->second->records.empty()) {
      declared.has_unknown = declared.has_unknown || !agent.program.empty();
      continue;
    }
    for (const std::string& name : names_of(kind->second->records)) {
      declared.names.push_back(name);
      declared.has_match = declared.has_match || pattern.has_value(name);
    }
  }
  return declared;
}

/// Whether some controller records what the scenario observes.
void judge_records(const sim::scenario::Scenario& scenario,
                   const std::map<std::string, const hal::ControllerKind*>& kinds,
                   ControllerJudgement& judgement) {
  const sim::scenario::RecordOptions& record = scenario.record;
  for (std::size_t i = 0; i < record.observables.size(); ++i) {
    const auto pattern = sim::record::ObservablePattern::of(record.observables[i].name);
    if (!pattern || pattern->domain != sim::record::kControllersDomain) continue;
    const DeclaredRecords declared = declared_records(scenario, *pattern, kinds);
    if (declared.has_match) continue;
    if (declared.has_unknown) {
      judgement.not_checked.push_back(
          fmt::format("{}: record.observables.name: not checked, a controller of {} does not "
                      "declare what it records",
                      record.observable_places[i], pattern->agents));
      continue;
    }
    judgement.mistakes.push_back(
        fmt::format("{}: record.observables.name: no controller of {} records '{}'{}",
                    record.observable_places[i], pattern->agents, pattern->value,
                    hal::config::suggestion(pattern->value, declared.names)));
  }
}

void judge_teleop(const sim::scenario::Scenario& scenario, const sim::scenario::Group& group,
                  std::vector<std::string>& mistakes) {
  if (group.inside) {
    mistakes.push_back(fmt::format("{}: program: '{}' is driven from outside: not with `inside`",
                                   group.program_place, kTeleop));
  }
  std::set<std::string> said;
  for (const hal::AgentId id : group.agents) {
    const sim::agents::AgentConfig& agent = config_of(scenario, id);
    if (!is_robot(agent) && said.insert(group.program_place).second) {
      mistakes.push_back(fmt::format("{}: program: '{}' does not drive agents like {}",
                                     group.program_place, kTeleop, agent.name));
    }
    for (const hal::exchange::ParameterText& parameter : agent.parameters) {
      if (!said.insert(parameter.place).second) continue;
      mistakes.push_back(fmt::format("{}: {}: is not a known parameter; {} has none",
                                     parameter.place, parameter.name, kTeleop));
    }
  }
}

}  // namespace

ControllerJudgement judge_controllers(const sim::scenario::Scenario& scenario) {
  ControllerJudgement judgement;
  std::map<std::string, const hal::ControllerKind*> kinds;
  for (const sim::scenario::Group& group : scenario.groups) {
    if (group.program.empty()) continue;  // nobody drives them
    if (group.program == kTeleop) {
      judge_teleop(scenario, group, judgement.mistakes);
      continue;
    }
    const auto kind = hal::runtime::load_plugin(group.program, hal::runtime::controller_folders());
    if (kind) {
      kinds[group.program] = *kind;
      for (const hal::RecordSpec& record : (*kind)->records) {
        judgement.recorded_units[{group.program, record.name}] = record.unit;
      }
      judge_group(scenario, group, **kind, judgement.mistakes);
      judge_channels(scenario, group, **kind, judgement.mistakes);
      judge_states(scenario, group, group.program, (*kind)->states, judgement);
    } else if (kind.error().code != hal::Errc::kNotAvailable) {
      judgement.mistakes.push_back(
          fmt::format("{}: program: {}", group.program_place, kind.error().message));
    } else if (find_program(group.program, hal::runtime::controller_folders())) {
      judgement.not_checked.push_back(fmt::format(
          "parameters, channels and states of {}: not checked, its plug-in is not there",
          group.program));
    } else {
      judgement.mistakes.push_back(fmt::format("{}: program: '{}' is no known controller: {}",
                                               group.program_place, group.program,
                                               kind.error().message));
    }
  }
  judge_records(scenario, kinds, judgement);
  return judgement;
}

sim::scenario::Scenario load_judged(const std::string& path,
                                    const std::vector<std::string>& overrides) {
  const auto file = hal::config::named_file(path, {"scenarios"});
  sim::scenario::Scenario scenario = sim::scenario::load_scenario(file, overrides);
  ControllerJudgement judgement = judge_controllers(scenario);
  if (!judgement.mistakes.empty()) {
    throw hal::config::ConfigErrors(std::move(judgement.mistakes));
  }
  scenario.record.recorded_units = std::move(judgement.recorded_units);
  for (const std::string& warning : scenario.warnings) fmt::print(stderr, "{}\n", warning);
  for (const std::string& line : judgement.not_checked) fmt::print(stderr, "{}\n", line);
  return scenario;
}

}  // namespace gateway
