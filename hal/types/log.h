#pragma once

#include <fmt/core.h>

#include <optional>
#include <string_view>
#include <utility>

#include "hal/types/time.h"

namespace hal::log {

/// Log lines of code that runs in the simulator and on hardware alike. Where they end up is the
/// program's choice (sim/core writes run.log through spdlog). The stamp is the agent's own time,
/// so two runs of one scenario log the same bytes.
enum class Level { kDebug, kInfo, kWarning, kError };

/// @param where  who speaks, e.g. "r0/controller".
using Sink = void (*)(Level level, Time at, std::string_view where, std::string_view text);

/// The sink of this process; standard error until set. Set once at start-up, before threads.
void set_sink(Sink sink);

/// Lines below this level are not formatted. Default: kInfo.
void set_level(Level level);
bool is_on(Level level);

/// @param where, text  of whatever origin: they are made printable (hal/types/printable.h).
void write(Level level, Time at, std::string_view where, std::string_view text);

template <class... Args>
void debug(Time at, std::string_view where, fmt::format_string<Args...> f, Args&&... args) {
  if (is_on(Level::kDebug)) {
    write(Level::kDebug, at, where, fmt::format(f, std::forward<Args>(args)...));
  }
}

template <class... Args>
void info(Time at, std::string_view where, fmt::format_string<Args...> f, Args&&... args) {
  if (is_on(Level::kInfo)) {
    write(Level::kInfo, at, where, fmt::format(f, std::forward<Args>(args)...));
  }
}

template <class... Args>
void warning(Time at, std::string_view where, fmt::format_string<Args...> f, Args&&... args) {
  if (is_on(Level::kWarning)) {
    write(Level::kWarning, at, where, fmt::format(f, std::forward<Args>(args)...));
  }
}

std::string_view name(Level level);
/// The level of that name; none if there is none.
std::optional<Level> level_called(std::string_view name);

}  // namespace hal::log
