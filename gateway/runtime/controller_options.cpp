#include "gateway/runtime/controller_options.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "gateway/process/command_line.h"
#include "gateway/runtime/parameter_form.h"
#include "hal/files/config/value.h"

namespace gateway::runtime {
namespace {

constexpr int kHighestDomain = 232;  // OMG DDSI-RTPS 2.5, 9.6.2.3: ports stay below 65536

std::string footer(const hal::ControllerKind& kind) {
  std::string text = "Parameters, given in the scenario:\n";
  for (const hal::ParameterSpec& p : kind.parameters) {
    const hal::files::config::Form form = form_of(p);
    const std::string range = limits(form);
    text += fmt::format("  {:<16} {} ({}; default {})\n", p.name, p.meaning,
                        range.empty() ? expected(form) : range, written(p, p.default_value));
  }
  return kind.parameters.empty() ? std::string{} : text;
}

hal::Duration parse_wait(const std::string& text) {
  if (text == "none") return hal::Duration::max();
  const hal::Result<double> value = process::parse_seconds(text, 0);
  if (!value) throw CLI::ValidationError("--wait", value.error().message);
  return hal::from_seconds(*value);
}

}  // namespace

ParsedOptions parse_controller_options(int argc, const char* const* argv,
                                       const hal::ControllerKind& kind) {
  ControllerOptions options;
  std::string wait = "30 s";
  CLI::App app("Controller " + kind.name + ": drives agents of a simulator or of a real robot.",
               kind.name);
  app.footer(footer(kind));
  app.add_option("--agents", options.agents, "Names or patterns (* and ?), may be repeated")
      ->required();
  app.add_option("--domain", options.domain, "DDS domain (default: BARAKA_DOMAIN, else 1)")
      ->transform(process::whole_number(0, kHighestDomain));
  app.add_option("--name", options.name, "Name of this process (default: program.pid)");
  app.add_flag("--stay", options.stay, "Wait for the next run after this one");
  app.add_option("--wait", wait,
                 "How long to wait for a server: 500 ms, 1 min, 30 (in s); none: for ever")
      ->capture_default_str();
  std::string level = "warning";
  app.add_option("--log", level, "What to say on standard error")
      ->transform(process::one_of({"debug", "info", "warning", "error"}))
      ->capture_default_str();
  process::complete(app, kind.name);
  try {
    app.parse(argc, argv);
    options.wait = parse_wait(wait);
    options.level = *hal::log::level_called(level);
  } catch (const CLI::ParseError& e) {
    return {.options = {}, .exit_status = process::end_of_parsing(app, e)};
  }
  return {.options = options, .exit_status = 0};
}

}  // namespace gateway::runtime
