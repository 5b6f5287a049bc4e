#pragma once

#include <fmt/core.h>

#include <optional>
#include <string_view>
#include <utility>

#include "hal/types/time.h"

namespace hal::log {

/// Severity of a log line. Code that runs in the simulator and on hardware logs by these functions;
/// the program chooses where the lines go (sim/core writes run.log through spdlog). Time stamps are
/// the agent's own time, so two runs of one scenario log the same bytes.
enum class Level { kDebug, kInfo, kWarning, kError };

/// Receives each line whose level is enabled. @param at  the agent's time.
/// @param where  source of the line, e.g. "r0/controller".
using Sink = void (*)(Level level, Time at, std::string_view where, std::string_view text);

/// The sink of this process; standard error until set. Set once at start-up, before threads.
void set_sink(Sink sink);

/// Lines below this level are not formatted. Default: kInfo.
void set_level(Level level);
/// Whether lines of this level are written.
bool is_on(Level level);

/// Hands a line to the sink. @param where, text  may be of any origin: control characters are
/// escaped (hal/types/printable.h).
void write(Level level, Time at, std::string_view where, std::string_view text);

/// Formats and writes a line of level kDebug if that level is on.
template <class... Args>
void debug(Time at, std::string_view where, fmt::format_string<Args...> f, Args&&... args) {
  if (is_on(Level::kDebug)) {
    write(Level::kDebug, at, where, fmt::format(f, std::forward<Args>(args)...));
  }
}

/// Formats and writes a line of level kInfo if that level is on.
template <class... Args>
void info(Time at, std::string_view where, fmt::format_string<Args...> f, Args&&... args) {
  if (is_on(Level::kInfo)) {
    write(Level::kInfo, at, where, fmt::format(f, std::forward<Args>(args)...));
  }
}

/// Formats and writes a line of level kWarning if that level is on.
template <class... Args>
void warning(Time at, std::string_view where, fmt::format_string<Args...> f, Args&&... args) {
  if (is_on(Level::kWarning)) {
    write(Level::kWarning, at, where, fmt::format(f, std::forward<Args>(args)...));
  }
}

/// "debug", "info", "warning" or "error".
std::string_view name(Level level);
/// The level with this name(); nullopt if there is none.
std::optional<Level> level_called(std::string_view name);

}  // namespace hal::log
