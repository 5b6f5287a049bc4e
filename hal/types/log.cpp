#include "hal/types/log.h"

#include <cstdio>
#include <string>

#include "hal/types/printable.h"

namespace hal::log {
namespace {

void to_standard_error(Level level, Time at, std::string_view where, std::string_view text) {
  fmt::print(stderr, "[{:.9f}] {} {}: {}\n", to_seconds(at), name(level), where, text);
}

Sink current_sink = to_standard_error;
Level lowest_level = Level::kInfo;

}  // namespace

void set_sink(Sink sink) { current_sink = sink; }
void set_level(Level level) { lowest_level = level; }
bool is_on(Level level) { return level >= lowest_level; }

void write(Level level, Time at, std::string_view where, std::string_view text) {
  if (is_on(level)) current_sink(level, at, printable(where), printable(text));
}

std::optional<Level> level_called(std::string_view name) {
  for (const Level level : {Level::kDebug, Level::kInfo, Level::kWarning, Level::kError}) {
    if (log::name(level) == name) return level;
  }
  return std::nullopt;
}

std::string_view name(Level level) {
  switch (level) {
    case Level::kDebug:
      return "debug";
    case Level::kInfo:
      return "info";
    case Level::kWarning:
      return "warning";
    case Level::kError:
      return "error";
  }
  return {};
}

}  // namespace hal::log
