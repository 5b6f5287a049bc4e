#pragma once

#include <filesystem>

#include "programs/topics/plan.h"
#include "sim/scenario/plan.h"
#include "sim/scenario/topic_parts.h"

namespace baraka::run::network {

/// What the participant of an agent writes and reads. @param planned  a player.
/// @param results  folder in which it writes its journal, an absolute path.
programs::topics::Plan topic_plan(const sim::scenario::PlannedProgram& planned,
                                  const sim::scenario::Scenario& scenario,
                                  const std::filesystem::path& results,
                                  sim::scenario::Recordings& recordings);

/// Writes it to the file that the player's command names. @throws std::runtime_error  it
/// cannot be written, or a recording cannot be read.
void write_topic_plan(const sim::scenario::PlannedProgram& planned,
                      const sim::scenario::Scenario& scenario, const std::filesystem::path& results,
                      sim::scenario::Recordings& recordings);

}  // namespace baraka::run::network
