#pragma once

#include "results/record/run_reader.h"
#include "results/report/run_result.h"

namespace results::report {

/// Reads the tables of agents with a network and of access points: use of the air by kind and
/// topic, samples of programs, relayed frames.
void read_air_use(record::RunReader& reader, RunResult& run);

}  // namespace results::report
