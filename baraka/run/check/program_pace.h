#pragma once

#include <optional>
#include <string>

#include "programs/netns/program_time.h"
#include "sim/scenario/scenario.h"

namespace baraka::run::check {

/// What a run does without `--pace`: "lockstep", but "realtime" with controllers inside their
/// agents' networks, which lock-step cannot hold yet.
std::string default_pace(const sim::scenario::Scenario& scenario);

/// The first group of agents whose controllers run inside their networks; null: there is none.
const sim::scenario::Group* first_with_controllers_inside(const sim::scenario::Scenario& scenario);

/// The factor of a pace, simulated seconds per second; none: lock-step.
/// @param pace  as for `--pace`. @throws UsageError  it is none.
std::optional<double> real_time_factor(const std::string& pace);

/// How time passes for the programs of a run. @param pace, @throws  as above.
programs::netns::ProgramTime program_time(const std::string& pace);

}  // namespace baraka::run::check
