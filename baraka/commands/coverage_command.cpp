#include "baraka/commands/coverage_command.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "baraka/commands/output_file.h"
#include "gateway/process/exit_status.h"
#include "hal/files/config/shared_folders.h"
#include "hal/files/config/value.h"
#include "hal/types/terminal_colours.h"
#include "results/coverage/coverage.h"
#include "results/coverage/coverage_csv.h"
#include "results/coverage/coverage_figure.h"
#include "results/coverage/survey_fit.h"
#include "sim/scenario/scenario.h"

namespace baraka::commands {
namespace {

using gateway::process::UsageError;
using hal::files::config::parse_value;
using results::coverage::Area;
using results::coverage::CoverageOptions;
using sim::scenario::Scenario;

/// "1.5 m", or "1.5" for it.
double metres(const char* option, const std::string& text, double low, double high) {
  auto value = parse_value(text, "m", low, high);
  if (!value) value = parse_value(text + " m", "m", low, high);
  if (!value)
    throw UsageError(
        fmt::format("coverage: {}: '{}' is not a length from {:g} m to {:g} m, such as 0.5 m",
                    option, text, low, high));
  return value.value();
}

Area area_of(const std::string& text) {
  std::array<double, 4> edges{};
  std::size_t begin = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const std::size_t end = text.find(',', begin);
    if ((end == std::string::npos) != (i + 1 == edges.size()))
      throw UsageError("coverage: --area takes two opposite corners, X,Y,X,Y, in m");
    edges.at(i) = metres("--area", text.substr(begin, end - begin), -1e6, 1e6);
    begin = end + 1;
  }
  if (edges[0] >= edges[2] || edges[1] >= edges[3])
    throw UsageError("coverage: --area: the first corner must have the lower x and y");
  return {{edges[0], edges[1]}, {edges[2], edges[3]}};
}

CoverageOptions options_of(const CoverageCommand& given) {
  CoverageOptions options{.of = given.of};
  if (!given.at.empty()) options.at = hal::Metres{metres("--at", given.at, 0, 1e4)};
  if (!given.step.empty()) options.step = hal::Metres{metres("--step", given.step, 1e-3, 1e4)};
  if (!given.area.empty()) options.area = area_of(given.area);
  if (!given.length.empty()) {
    constexpr double kLongest = 65535;
    auto bytes = parse_value(given.length, "1", 1, kLongest);
    if (!bytes)
      throw UsageError(
          fmt::format("coverage: --length: '{}' is not a number of bytes "
                      "from 1 to {:g}",
                      given.length, kLongest));
    options.bytes = static_cast<std::uint32_t>(bytes.value());
  }
  return options;
}

Scenario scenario_of(const std::string& named, const std::vector<std::string>& overrides) {
  const auto file = hal::files::config::named_file(named, {"scenarios"});
  Scenario scenario = sim::scenario::load_scenario(file, overrides);
  for (const std::string& warning : scenario.warnings)
    hal::print_line(hal::Tone::kWarning, warning);
  return scenario;
}

results::coverage::Layer layer_of(const std::string& name) {
  for (const auto& one : results::coverage::kLayers)
    if (one.name == name) return one.layer;
  throw UsageError(fmt::format("coverage: --layer: '{}' is not rssi, snr, best or rate", name));
}

}  // namespace

int coverage(const CoverageCommand& given) {
  namespace map = results::coverage;
  const CoverageOptions options = options_of(given);
  const map::Layer layer = layer_of(given.layer);
  const auto kind = std::filesystem::path(given.file).extension();
  if (!given.file.empty() && kind != ".html" && kind != ".svg" && kind != ".csv")
    throw UsageError(
        fmt::format("coverage: -o {}: the file must end in .html, .svg or .csv", given.file));
  const Scenario scenario = scenario_of(given.scenario, given.overrides);
  const map::Coverage found = map::coverage_of(scenario.simulation, options);
  const auto& walls = scenario.simulation.walls;
  if (kind == ".html") {
    write_output(given.file, map::coverage_page(found, scenario.name, walls));
  } else if (kind == ".svg") {
    write_output(given.file, map::coverage_svg(found, layer, walls));
  } else if (kind == ".csv") {
    write_output(given.file, map::coverage_csv(found));
  } else {
    write_output({}, map::coverage_text(found));
  }
  return gateway::process::kDone;
}

int survey(const SurveyCommand& given) {
  namespace map = results::coverage;
  const Scenario scenario = scenario_of(given.scenario, given.overrides);
  const auto rows = map::read_survey(given.survey);
  const map::SurveyFit fit = map::fit_survey(scenario.simulation, rows);
  for (const std::string& warning : fit.warnings)
    hal::print_line(hal::Tone::kWarning, fmt::format("warning: {}", warning));
  write_output({}, map::survey_text(fit));
  if (!given.file.empty()) {
    const std::string what =
        fmt::format("The multi-wall law, fitted by baraka survey to {} over the walls of {}.",
                    given.survey, scenario.name);
    write_output(given.file, map::survey_radio(scenario.simulation, fit, what));
  }
  return gateway::process::kDone;
}

}  // namespace baraka::commands
