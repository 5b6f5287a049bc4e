#pragma once

#include "sim/scenario/scenario.h"

namespace gateway {

/// Whether every program that runs inside an agent can be found: before a run starts, as one may
/// be due only late in it. What a run is to make itself ({results}) is not looked for.
/// @throws hal::config::ConfigErrors  "file:line:column: command: …" for each that is not there.
void judge_programs(const sim::scenario::Scenario& scenario);

}  // namespace gateway
