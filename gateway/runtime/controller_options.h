#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal/api/controller.h"
#include "hal/types/log.h"
#include "hal/types/time.h"

namespace gateway::runtime {

/// Options of a controller program.
struct ControllerOptions {
  std::vector<std::string> agents;  ///< Patterns; `*` and `?` match as in a shell. At least one.
  std::optional<int> domain;        ///< DDS domain, 0..232; empty: the environment decides.
  std::string name;                 ///< Name of the process; empty: program.pid.
  bool stay = false;                ///< After a run, wait for the next one.
  hal::Duration wait = std::chrono::seconds{30};      ///< For a server; Duration::max(): no limit.
  hal::log::Level level = hal::log::Level::kWarning;  ///< For messages of the process itself.
};

/// The options. If there are none, help or an error has been printed, and the program should end
/// with `exit_status` (0 after --help, 2 after a mistake).
struct ParsedOptions {
  std::optional<ControllerOptions> options;
  int exit_status = 0;
};

/// Reads the command line. --help lists the parameters of `kind` too, for writers of scenarios.
ParsedOptions parse_controller_options(int argc, const char* const* argv,
                                       const hal::ControllerKind& kind);

}  // namespace gateway::runtime
