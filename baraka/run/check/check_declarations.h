#pragma once

#include <map>
#include <string>
#include <vector>

#include "baraka/run/check/check_controllers.h"
#include "hal/api/controller.h"
#include "sim/scenario/scenario.h"

namespace baraka::run::check {

/// The states of each program that declares some, and of programs that declare none.
using StatesOf = std::map<std::string, std::vector<std::string>>;

/// For the results: what there can be a count of, be it 0.
void note_declared(const std::string& program, const hal::ControllerKind& kind,
                   ControllerFindings& findings);

/// Whether somebody of whom a state is awaited enters it.
/// @param states  of the programs whose plug-ins are there.
void check_states(const sim::scenario::Scenario& scenario, const StatesOf& states,
                  ControllerFindings& findings);

/// Whether some controller records what the scenario observes.
/// @param kinds  by controller; without those whose plug-in is not there.
void check_records(const sim::scenario::Scenario& scenario,
                   const std::map<std::string, const hal::ControllerKind*>& kinds,
                   ControllerFindings& findings);

}  // namespace baraka::run::check
