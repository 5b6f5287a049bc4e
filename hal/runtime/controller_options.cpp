#include "hal/runtime/controller_options.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>

#include "hal/config/value.h"

namespace hal::runtime {
namespace {

constexpr int kHighestDomain = 232;  // OMG DDSI-RTPS 2.5, 9.6.2.3: ports stay below 65536

std::string footer(const ControllerKind& kind) {
  std::string text = "Parameters, given in the scenario:\n";
  for (const ParameterSpec& p : kind.parameters) {
    text += fmt::format("  {:<16} {} ({} to {}; default {})\n", p.name, p.meaning,
                        config::format_value(p.low, p.unit), config::format_value(p.high, p.unit),
                        config::format_value(p.default_value, p.unit));
  }
  return kind.parameters.empty() ? std::string{} : text;
}

/// "30 s", "500 ms", "none", or a plain number of seconds, as is usual on a command line.
Duration parse_wait(const std::string& text) {
  constexpr double kForEver = std::numeric_limits<double>::infinity();
  Result<double> seconds = config::parse_value(text, "1", 0, kForEver);
  if (!seconds) seconds = config::parse_value(text, "s", 0, kForEver);
  if (!seconds) throw CLI::ValidationError("--wait", seconds.error().message);
  constexpr double kLongest = 9e9;  // s, what from_seconds() takes
  return *seconds < kLongest ? from_seconds(*seconds) : Duration::max();
}

}  // namespace

ParsedOptions parse_controller_options(int argc, const char* const* argv,
                                       const ControllerKind& kind) {
  ControllerOptions options;
  std::string wait = "30 s";
  CLI::App app("Controller " + kind.name + ": drives agents of a simulator or of a real robot.",
               kind.name);
  app.footer(footer(kind));
  app.add_option("--agents", options.agents, "Names or patterns (* and ?), may be repeated")
      ->required();
  app.add_option("--domain", options.domain, "DDS domain (default: BARAKA_DOMAIN, else 1)")
      ->check(CLI::Range(0, kHighestDomain));
  app.add_option("--name", options.name, "Name of this process (default: program.pid)");
  app.add_flag("--stay", options.stay, "Wait for the next run after this one");
  app.add_option("--wait", wait, "How long to wait for a server, e.g. 30 s; none: for ever")
      ->capture_default_str();
  try {
    app.parse(argc, argv);
    options.wait = parse_wait(wait);
  } catch (const CLI::ParseError& e) {
    constexpr int kUsage = 2;
    return {.options = {}, .exit_status = app.exit(e) == 0 ? 0 : kUsage};
  }
  return {.options = options, .exit_status = 0};
}

}  // namespace hal::runtime
