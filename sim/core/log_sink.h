#pragma once

#include <string>

#include "hal/types/log.h"

namespace sim {

/// Sends the log lines of hal/types/log.h to a file, and warnings and errors to standard error too.
/// The stamps are simulated time, so two runs of one scenario write the same bytes.
///
/// @param lowest  lines below this level are left out.
/// @param path  created or truncated. Throws std::runtime_error if it cannot be written.
/// Not thread-safe: call at start-up.
void log_to_file(const std::string& path, hal::log::Level lowest = hal::log::Level::kInfo);

/// Writes the buffered lines.
void flush_log();

}  // namespace sim
