#include "baraka/run/check/check_declarations.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "baraka/run/check/config_of.h"
#include "hal/files/config/suggest.h"

namespace baraka::run::check {
namespace {

/// The controllers of some agents, in order; empty for agents without a controller.
std::vector<std::string> programs_of(const std::vector<hal::AgentId>& agents,
                                     const sim::scenario::Scenario& scenario) {
  std::vector<std::string> programs;
  for (const hal::AgentId id : agents) {
    const std::string& program = config_of(scenario, id).program;
    if (std::ranges::find(programs, program) == programs.end()) programs.push_back(program);
  }
  return programs;
}

/// The states that some controllers may enter.
struct Enterable {
  std::vector<std::string> states;
  std::vector<std::string> silent;  ///< Controllers that declare none.
  bool is_all = false;              ///< The states of at least one controller are not known.
};
Enterable enterable(const std::vector<std::string>& programs, const StatesOf& states) {
  Enterable all;
  for (const std::string& program : programs) {
    const auto declared = states.find(program);
    if (declared == states.end()) {
      all.is_all |= !program.empty();  // the plug-in was not found
      continue;
    }
    if (declared->second.empty()) all.silent.push_back(program);
    all.states.insert(all.states.end(), declared->second.begin(), declared->second.end());
  }
  all.is_all |= !all.silent.empty();
  return all;
}

std::vector<std::string> names_of(const std::vector<hal::RecordSpec>& records) {
  std::vector<std::string> names;
  names.reserve(records.size());
  for (const hal::RecordSpec& record : records) names.push_back(record.name);
  return names;
}

/// The values that the controllers of the agents matching a pattern declare to record.
struct DeclaredRecords {
  std::vector<std::string> names{};
  bool has_match = false;
  bool has_unknown = false;  ///< At least one controller does not declare what it records.
};

/// @param kinds  by controller, without those whose plug-in was not found.
DeclaredRecords declared_records(const sim::scenario::Scenario& scenario,
                                 const sim::scenario::ObservablePattern& pattern,
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

}  // namespace

void note_declared(const std::string& program, const hal::ControllerKind& kind,
                   ControllerFindings& findings) {
  for (const std::string& state : kind.states) {
    findings.declared.push_back({"states", program, state});
  }
  for (const hal::RecordSpec& record : kind.records) {
    findings.declared.push_back({"controllers", program, record.name});
    findings.recorded_units[{program, record.name}] = record.unit;
  }
}

void check_states(const sim::scenario::Scenario& scenario, const StatesOf& states,
                  ControllerFindings& findings) {
  std::set<std::string> said;
  for (const sim::scenario::AwaitedState& awaited : scenario.awaited) {
    const std::vector<std::string> programs = programs_of(awaited.agents, scenario);
    const auto [all, silent, may_enter] = enterable(programs, states);
    for (const std::string& program : silent) {
      if (!said.insert(program).second) continue;
      findings.not_checked.push_back(
          fmt::format("states of {}: not checked, it declares none", program));
    }
    if (may_enter || std::ranges::find(all, awaited.state) != all.end()) continue;
    findings.mistakes.push_back(fmt::format("{}: {}: {} declare{} no state '{}'{}", awaited.place,
                                            awaited.key, fmt::join(programs, " and "),
                                            programs.size() == 1 ? "s" : "", awaited.state,
                                            hal::files::config::suggestion(awaited.state, all)));
  }
}

void check_records(const sim::scenario::Scenario& scenario,
                   const std::map<std::string, const hal::ControllerKind*>& kinds,
                   ControllerFindings& findings) {
  const sim::scenario::RecordOptions& record = scenario.record;
  for (std::size_t i = 0; i < record.observables.size(); ++i) {
    const auto pattern = sim::scenario::ObservablePattern::of(record.observables[i].name);
    if (!pattern || pattern->domain != sim::scenario::kControllersDomain) continue;
    const DeclaredRecords declared = declared_records(scenario, *pattern, kinds);
    if (declared.has_match) continue;
    if (declared.has_unknown) {
      findings.not_checked.push_back(
          fmt::format("{}: record.observables.name: not checked, a controller of {} does not "
                      "declare what it records",
                      record.observable_places[i], pattern->agents));
      continue;
    }
    findings.mistakes.push_back(
        fmt::format("{}: record.observables.name: no controller of {} records '{}'{}",
                    record.observable_places[i], pattern->agents, pattern->value,
                    hal::files::config::suggestion(pattern->value, declared.names)));
  }
}

}  // namespace baraka::run::check
