#pragma once

#include <map>
#include <string>
#include <vector>

#include "baraka/run/check/check_controllers.h"
#include "hal/api/controller.h"
#include "sim/scenario/scenario.h"

namespace baraka::run::check {

/// Declared states by controller; an empty list: the controller declares none.
using StatesOf = std::map<std::string, std::vector<std::string>>;

/// Notes for the results what a controller can be counted for, so that a count of 0 is recorded
/// too.
void note_declared(const std::string& program, const hal::ControllerKind& kind,
                   ControllerFindings& findings);

/// Checks that a state that the scenario waits for can be entered by one of the agents concerned.
/// @param states  of the controllers whose plug-ins were found.
void check_states(const sim::scenario::Scenario& scenario, const StatesOf& states,
                  ControllerFindings& findings);

/// Checks that some controller records each value that the scenario observes.
/// @param kinds  by controller, without those whose plug-in was not found.
void check_records(const sim::scenario::Scenario& scenario,
                   const std::map<std::string, const hal::ControllerKind*>& kinds,
                   ControllerFindings& findings);

}  // namespace baraka::run::check
