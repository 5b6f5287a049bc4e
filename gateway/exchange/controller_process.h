#pragma once

#include "gateway/exchange/client.h"
#include "gateway/runtime/controller_host.h"
#include "gateway/runtime/controller_options.h"

namespace gateway::exchange {

/// Result of a controller process; the exit status of its program.
enum class Outcome {
  kDone = 0,           ///< The run ended.
  kFailed = 1,         ///< No server answered, or the server died.
  kRefused = 2,        ///< Every server refused, or a parameter is wrong.
  kInterrupted = 130,  ///< SIGINT or SIGTERM.
};

/// Runs the controllers of one process until the run ends: Hello, Session, then one Step after the
/// other. With options.stay it then waits for the next run. Problems are reported on standard
/// error. SIGINT and SIGTERM end it; a second one kills a controller that hangs.
/// @throws std::runtime_error  if DDS cannot be opened.
Outcome run_controllers(const hal::ControllerKind& kind, const runtime::ControllerOptions& options);

/// The same for a client that has already sent hello_of(kind, options). Does not change signal
/// handlers.
Outcome run_controllers(const hal::ControllerKind& kind, const runtime::ControllerOptions& options,
                        Client& client);

/// The Hello of a process with these options.
hal::node::exchange::Hello hello_of(const hal::ControllerKind& kind,
                                    const runtime::ControllerOptions& options);

}  // namespace gateway::exchange
