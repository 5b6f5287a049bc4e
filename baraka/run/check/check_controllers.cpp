#include "baraka/run/check/check_controllers.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "baraka/run/check/check_declarations.h"
#include "baraka/run/check/check_names.h"
#include "baraka/run/check/config_of.h"
#include "baraka/run/controllers/controller_path.h"
#include "gateway/runtime/check_parameters.h"
#include "gateway/runtime/controller_command.h"
#include "gateway/runtime/plugin.h"
#include "gateway/runtime/python_file.h"
#include "gateway/server/teleop_port.h"
#include "hal/node/exchange/ports.h"
#include "sim/agents/agent_offer.h"

namespace baraka::run::check {
namespace {

/// Whether the controller can be started as a process.
bool has_command(const std::string& program) {
  return !gateway::runtime::controller_command(program, gateway::runtime::controller_folders())
              .empty();
}

bool drives(const hal::ControllerKind& kind, const sim::agents::AgentConfig& agent) {
  return is_robot(agent) ? kind.make_for_robot != nullptr : kind.make_for_mote != nullptr;
}

void check_group(const sim::scenario::Scenario& scenario, const sim::scenario::Group& group,
                 const hal::ControllerKind& kind, std::vector<std::string>& mistakes) {
  std::set<std::string> said;  // agents of a group share their parameters: say each mistake once
  for (const hal::AgentId id : group.agents) {
    const sim::agents::AgentConfig& agent = config_of(scenario, id);
    if (!drives(kind, agent) && said.insert(group.program_place).second) {
      mistakes.push_back(fmt::format("{}: program: '{}' does not drive agents like {}",
                                     group.program_place, group.program, agent.name));
    }
    for (std::string& mistake : gateway::runtime::check_parameters(kind, agent.parameters)) {
      if (said.insert(mistake).second) mistakes.push_back(std::move(mistake));
    }
  }
}

/// Checks that each agent offers the channels that the controller requires.
void check_channels(const sim::scenario::Scenario& scenario, const sim::scenario::Group& group,
                    const hal::ControllerKind& kind, std::vector<std::string>& mistakes) {
  for (const hal::AgentId id : group.agents) {
    const sim::agents::AgentConfig& agent = config_of(scenario, id);
    if (!drives(kind, agent)) continue;
    const auto offer = sim::agents::offer_of(agent, scenario.simulation);
    const auto session = hal::node::exchange::session_for(offer, kind.wants);
    if (session) continue;
    mistakes.push_back(fmt::format("{}: program: '{}' needs a channel: {}", group.program_place,
                                   group.program, session.error().message));
    return;  // the other agents of the group have the same body
  }
}

void check_teleop(const sim::scenario::Scenario& scenario, const sim::scenario::Group& group,
                  const RunMode& mode, std::vector<std::string>& mistakes) {
  const bool in_process = mode.controllers == controllers::ControllersFrom::kInProcess;
  if (in_process && !mode.has_domain && !mode.is_repeated) {
    mistakes.push_back(
        fmt::format("{}: program: '{}' needs a DDS domain, and a run with its controllers in "
                    "process has none: --inspect-domain N",
                    group.program_place, gateway::server::kTeleop));
  }
  if (group.inside) {
    mistakes.push_back(fmt::format("{}: program: '{}' is driven from outside: not with `inside`",
                                   group.program_place, gateway::server::kTeleop));
  }
  std::set<std::string> said;
  for (const hal::AgentId id : group.agents) {
    const sim::agents::AgentConfig& agent = config_of(scenario, id);
    if (!is_robot(agent) && said.insert(group.program_place).second) {
      mistakes.push_back(fmt::format("{}: program: '{}' does not drive agents like {}",
                                     group.program_place, gateway::server::kTeleop, agent.name));
    }
    for (const hal::node::exchange::ParameterText& parameter : agent.parameters) {
      if (!said.insert(parameter.place).second) continue;
      mistakes.push_back(fmt::format("{}: {}: is not a known parameter; {} has none",
                                     parameter.place, parameter.name, gateway::server::kTeleop));
    }
  }
}

/// Checks that a controller whose plug-in was found also exists in the form that the run needs.
void check_form(const sim::scenario::Group& group, const RunMode& mode,
                std::vector<std::string>& mistakes) {
  if (mode.controllers != controllers::ControllersFrom::kSpawn) return;
  if (has_command(group.program)) return;
  mistakes.push_back(fmt::format(
      "{}: program: '{}' has no executable, only a plug-in; use --controllers in-process",
      group.program_place, group.program));
}

/// Checks that the run can start the controller inside its agent's network, if it belongs there.
void check_inside(const sim::scenario::Group& group, const RunMode& mode,
                  std::vector<std::string>& mistakes) {
  if (!group.inside || mode.is_repeated || mode.controllers == controllers::ControllersFrom::kSpawn)
    return;
  mistakes.push_back(fmt::format(
      "{}: program: '{}' is to run inside its agent's network, where only the run can start it: "
      "controllers must be spawn, not {}",
      group.program_place, group.program,
      mode.controllers == controllers::ControllersFrom::kExternal ? "external" : "in-process"));
}

/// Notes that the controller's plug-in was not found.
void check_without_plugin(const sim::scenario::Group& group, const RunMode& mode,
                          const hal::Error& error, ControllerFindings& findings) {
  const auto add = [&](const std::string& what) {
    findings.mistakes.push_back(fmt::format("{}: program: {}", group.program_place, what));
  };
  if (error.code != hal::Errc::kNotAvailable) return add(error.message);
  const bool python_is_missing = mode.controllers == controllers::ControllersFrom::kSpawn &&
                                 gateway::runtime::is_python(group.program);
  if (!has_command(group.program) || python_is_missing ||
      mode.controllers == controllers::ControllersFrom::kInProcess) {
    controllers::warn_of_missing_controller_folders();
    return add(error.message);
  }
  findings.not_checked.push_back(
      fmt::format("parameters, channels and states of {}: not checked, its plug-in is not there",
                  group.program));
}

}  // namespace

ControllerFindings check_controllers(const sim::scenario::Scenario& scenario, const RunMode& mode) {
  ControllerFindings findings;
  std::map<std::string, const hal::ControllerKind*> kinds;
  StatesOf states;
  NamesCheck names(scenario);
  for (const sim::scenario::Group& group : scenario.groups) {
    if (group.program.empty()) continue;  // agents without a controller
    if (group.program == gateway::server::kTeleop) {
      check_teleop(scenario, group, mode, findings.mistakes);
      continue;
    }
    check_inside(group, mode, findings.mistakes);
    const auto kind =
        gateway::runtime::load_plugin(group.program, gateway::runtime::controller_folders());
    if (!kind) {
      check_without_plugin(group, mode, kind.error(), findings);
      names.add_unknown();
      continue;
    }
    kinds[group.program] = *kind;
    note_declared(group.program, **kind, findings);
    check_form(group, mode, findings.mistakes);
    check_group(scenario, group, **kind, findings.mistakes);
    check_channels(scenario, group, **kind, findings.mistakes);
    names.add(group, **kind);
    states[group.program] = (*kind)->states;
  }
  names.finish(findings.mistakes, findings.warnings);
  check_records(scenario, kinds, findings);
  check_states(scenario, states, findings);
  return findings;
}

}  // namespace baraka::run::check
