#include "gateway/run/judge_controllers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "gateway/find_program.h"
#include "gateway/run/controller_path.h"
#include "gateway/run/judge_names.h"
#include "gateway/run/judge_programs.h"
#include "gateway/teleop_port.h"
#include "hal/config/errors.h"
#include "hal/config/shared_folders.h"
#include "hal/config/suggest.h"
#include "hal/exchange/ports.h"
#include "hal/runtime/check_parameters.h"
#include "hal/runtime/plugin.h"
#include "hal/types/terminal_colours.h"
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

/// The states of each program that declares some, and of programs that declare none.
using StatesOf = std::map<std::string, std::vector<std::string>>;

/// The programs of some agents, in order; empty for those that nobody drives.
std::vector<std::string> programs_of(const std::vector<hal::AgentId>& agents,
                                     const sim::scenario::Scenario& scenario) {
  std::vector<std::string> programs;
  for (const hal::AgentId id : agents) {
    const std::string& program = config_of(scenario, id).program;
    if (std::ranges::find(programs, program) == programs.end()) programs.push_back(program);
  }
  return programs;
}

/// What some programs may enter.
struct Enterable {
  std::vector<std::string> states;
  std::vector<std::string> silent;  ///< Programs that declare none.
  bool is_all = false;              ///< Of one of them it is not known.
};
Enterable enterable(const std::vector<std::string>& programs, const StatesOf& states) {
  Enterable all;
  for (const std::string& program : programs) {
    const auto declared = states.find(program);
    if (declared == states.end()) {
      all.is_all |= !program.empty();  // its plug-in is not there
      continue;
    }
    if (declared->second.empty()) all.silent.push_back(program);
    all.states.insert(all.states.end(), declared->second.begin(), declared->second.end());
  }
  all.is_all |= !all.silent.empty();
  return all;
}

/// Whether somebody of whom a state is awaited enters it.
/// @param states  of the programs whose plug-ins are there.
void judge_states(const sim::scenario::Scenario& scenario, const StatesOf& states,
                  ControllerJudgement& judgement) {
  std::set<std::string> said;
  for (const sim::scenario::AwaitedState& awaited : scenario.awaited) {
    const std::vector<std::string> programs = programs_of(awaited.agents, scenario);
    const auto [all, silent, may_enter] = enterable(programs, states);
    for (const std::string& program : silent) {
      if (!said.insert(program).second) continue;
      judgement.not_checked.push_back(
          fmt::format("states of {}: not checked, it declares none", program));
    }
    if (may_enter || std::ranges::find(all, awaited.state) != all.end()) continue;
    judgement.mistakes.push_back(fmt::format("{}: {}: {} declare{} no state '{}'{}", awaited.place,
                                             awaited.key, fmt::join(programs, " and "),
                                             programs.size() == 1 ? "s" : "", awaited.state,
                                             hal::config::suggestion(awaited.state, all)));
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

/// For the results: what there can be a count of, be it 0.
void note_declared(const std::string& program, const hal::ControllerKind& kind,
                   ControllerJudgement& judgement) {
  for (const std::string& state : kind.states) {
    judgement.declared.push_back({"states", program, state});
  }
  for (const hal::RecordSpec& record : kind.records) {
    judgement.declared.push_back({"controllers", program, record.name});
    judgement.recorded_units[{program, record.name}] = record.unit;
  }
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
                  const RunWay& way, std::vector<std::string>& mistakes) {
  const bool in_process = way.controllers == ControllersFrom::kInProcess;
  if (in_process && !way.has_domain && !way.is_repeated) {
    mistakes.push_back(
        fmt::format("{}: program: '{}' needs a DDS domain, and a run with its controllers in "
                    "process has none: --inspect-domain N",
                    group.program_place, kTeleop));
  }
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

/// Whether the controller is there in the form that the run needs: its plug-in was found.
void judge_form(const sim::scenario::Group& group, const RunWay& way,
                std::vector<std::string>& mistakes) {
  if (way.controllers != ControllersFrom::kSpawn) return;
  if (find_program(group.program, hal::runtime::controller_folders())) return;
  mistakes.push_back(fmt::format(
      "{}: program: '{}' is not there to be started, only its plug-in is: --controllers in-process",
      group.program_place, group.program));
}

/// Whether the run can start it inside its agent's network, if it is to be there.
void judge_inside(const sim::scenario::Group& group, const RunWay& way,
                  std::vector<std::string>& mistakes) {
  if (!group.inside || way.is_repeated || way.controllers == ControllersFrom::kSpawn) return;
  mistakes.push_back(fmt::format(
      "{}: program: '{}' is to run inside its agent's network, where only the run can start it: "
      "controllers must be spawn, not {}",
      group.program_place, group.program,
      way.controllers == ControllersFrom::kExternal ? "external" : "in-process"));
}

/// Its plug-in was not found.
void judge_without_plugin(const sim::scenario::Group& group, const RunWay& way,
                          const hal::Error& error, ControllerJudgement& judgement) {
  const auto add = [&](const std::string& what) {
    judgement.mistakes.push_back(fmt::format("{}: program: {}", group.program_place, what));
  };
  if (error.code != hal::Errc::kNotAvailable) return add(error.message);
  const bool has_program =
      find_program(group.program, hal::runtime::controller_folders()).has_value();
  if (!has_program || way.controllers == ControllersFrom::kInProcess) {
    warn_of_missing_controller_folders();
    return add(error.message);
  }
  judgement.not_checked.push_back(
      fmt::format("parameters, channels and states of {}: not checked, its plug-in is not there",
                  group.program));
}

}  // namespace

ControllerJudgement judge_controllers(const sim::scenario::Scenario& scenario, const RunWay& way) {
  ControllerJudgement judgement;
  std::map<std::string, const hal::ControllerKind*> kinds;
  StatesOf states;
  NamesJudge names(scenario);
  for (const sim::scenario::Group& group : scenario.groups) {
    if (group.program.empty()) continue;  // nobody drives them
    if (group.program == kTeleop) {
      judge_teleop(scenario, group, way, judgement.mistakes);
      continue;
    }
    judge_inside(group, way, judgement.mistakes);
    const auto kind = hal::runtime::load_plugin(group.program, hal::runtime::controller_folders());
    if (!kind) {
      judge_without_plugin(group, way, kind.error(), judgement);
      names.add_unknown();
      continue;
    }
    kinds[group.program] = *kind;
    note_declared(group.program, **kind, judgement);
    judge_form(group, way, judgement.mistakes);
    judge_group(scenario, group, **kind, judgement.mistakes);
    judge_channels(scenario, group, **kind, judgement.mistakes);
    names.add(group, **kind);
    states[group.program] = (*kind)->states;
  }
  names.finish(judgement.mistakes, judgement.warnings);
  judge_records(scenario, kinds, judgement);
  judge_states(scenario, states, judgement);
  return judgement;
}

JudgedScenario judge_scenario(const std::filesystem::path& file,
                              const std::vector<std::string>& overrides, const RunWay& way) {
  JudgedScenario judged{sim::scenario::load_scenario(file, overrides), {}};
  sim::scenario::Scenario& scenario = judged.scenario;
  ControllerJudgement judgement = judge_controllers(scenario, way);
  if (!way.is_repeated) {
    std::ranges::move(unusable_programs(scenario, way.factor),
                      std::back_inserter(judgement.mistakes));
  }
  if (!judgement.mistakes.empty()) {
    throw hal::config::ConfigErrors(std::move(judgement.mistakes));
  }
  scenario.record.recorded_units = std::move(judgement.recorded_units);
  scenario.record.declared = std::move(judgement.declared);
  for (const auto* lines : {&scenario.warnings, &judgement.warnings, &judgement.not_checked}) {
    judged.remarks.insert(judged.remarks.end(), lines->begin(), lines->end());
  }
  return judged;
}

sim::scenario::Scenario load_judged(const std::string& path,
                                    const std::vector<std::string>& overrides, const RunWay& way) {
  JudgedScenario judged =
      judge_scenario(hal::config::named_file(path, {"scenarios"}), overrides, way);
  for (const std::string& line : judged.remarks) hal::print_line(hal::Tone::kWarning, line);
  return std::move(judged.scenario);
}

}  // namespace gateway
