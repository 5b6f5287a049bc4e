#pragma once

#include <filesystem>

#include "programs/topics/plan.h"
#include "sim/scenario/plan.h"

namespace baraka::run::network {

/// What the participant of an agent writes and reads. @param planned  a player.
/// @param results  folder in which it writes its journal, an absolute path.
programs::topics::Plan topic_plan(const sim::scenario::PlannedProgram& planned,
                                  const sim::scenario::Scenario& scenario,
                                  const std::filesystem::path& results);

/// Writes it to the file that the player's command names. @throws std::runtime_error
void write_topic_plan(const sim::scenario::PlannedProgram& planned,
                      const sim::scenario::Scenario& scenario,
                      const std::filesystem::path& results);

}  // namespace baraka::run::network
