#include "sim/core/log_sink.h"

#include <spdlog/sinks/ansicolor_sink.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <memory>
#include <stdexcept>

#include "hal/types/terminal_colours.h"

namespace sim {
namespace {

std::unique_ptr<spdlog::logger>& logger() {
  static std::unique_ptr<spdlog::logger> instance;
  return instance;
}

spdlog::level::level_enum to_spdlog(hal::log::Level level) {
  switch (level) {
    case hal::log::Level::kDebug:
      return spdlog::level::debug;
    case hal::log::Level::kInfo:
      return spdlog::level::info;
    case hal::log::Level::kWarning:
      return spdlog::level::warn;
    case hal::log::Level::kError:
      return spdlog::level::err;
  }
  return spdlog::level::off;
}

void write(hal::log::Level level, hal::Time at, std::string_view where, std::string_view text) {
  constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
  const std::int64_t ns = hal::to_ns(at);
  logger()->log(to_spdlog(level), "[{:4}.{:09}] {} {}: {}", ns / kNanosecondsPerSecond,
                ns % kNanosecondsPerSecond, hal::log::name(level), where, text);
}

}  // namespace

void log_to_file(const std::string& path, hal::log::Level lowest) {
  try {
    auto file = std::make_shared<spdlog::sinks::basic_file_sink_mt>(path, true);
    auto standard_error = std::make_shared<spdlog::sinks::ansicolor_stderr_sink_mt>(
        hal::shows_colours(stderr) ? spdlog::color_mode::always : spdlog::color_mode::never);
    standard_error->set_level(spdlog::level::warn);
    logger() = std::make_unique<spdlog::logger>(
        "baraka", spdlog::sinks_init_list{std::move(file), std::move(standard_error)});
  } catch (const spdlog::spdlog_ex& e) {
    throw std::runtime_error(e.what());
  }
  logger()->set_level(spdlog::level::debug);
  logger()->set_pattern("%^%v%$");  // the whole line in the colour of its level
  logger()->flush_on(spdlog::level::warn);
  hal::log::set_level(lowest);
  hal::log::set_sink(write);
}

void flush_log() {
  if (logger()) logger()->flush();
}

}  // namespace sim
