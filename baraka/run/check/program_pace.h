#pragma once

#include <optional>
#include <string>

#include "programs/netns/program_time.h"

namespace baraka::run::check {

/// What a run does without `--pace`.
inline constexpr const char* kDefaultPace = "lockstep";

/// The factor of a pace, simulated seconds per second; none: lock-step.
/// @param pace  as for `--pace`. @throws UsageError  it is none.
std::optional<double> real_time_factor(const std::string& pace);

/// Programs that follow the wall clock can be slowed, not hastened.
/// @throws UsageError  the pace is in real time and its factor is none for programs.
void require_pace_for_programs(const std::string& pace);

/// How time passes for the programs of a run. @param pace, @throws  as above.
programs::netns::ProgramTime program_time(const std::string& pace);

}  // namespace baraka::run::check
