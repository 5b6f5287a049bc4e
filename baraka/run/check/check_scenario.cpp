#include "baraka/run/check/check_scenario.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "baraka/run/check/check_programs.h"
#include "baraka/run/check/program_pace.h"
#include "hal/files/config/errors.h"
#include "hal/files/config/shared_folders.h"
#include "hal/types/terminal_colours.h"

namespace baraka::run::check {

CheckedScenario check_scenario(const std::filesystem::path& file,
                               const std::vector<std::string>& overrides, const RunMode& mode) {
  CheckedScenario checked{sim::scenario::load_scenario(file, overrides), {}};
  sim::scenario::Scenario& scenario = checked.scenario;
  ControllerFindings findings = check_controllers(scenario, mode);
  if (!mode.is_repeated) {
    std::ranges::move(unusable_programs(scenario, mode.time.value_or(program_time(kDefaultPace))),
                      std::back_inserter(findings.mistakes));
  }
  if (!findings.mistakes.empty()) {
    throw hal::files::config::ConfigErrors(std::move(findings.mistakes));
  }
  scenario.record.recorded_units = std::move(findings.recorded_units);
  scenario.record.declared = std::move(findings.declared);
  for (const auto* lines : {&scenario.warnings, &findings.warnings, &findings.not_checked}) {
    checked.remarks.insert(checked.remarks.end(), lines->begin(), lines->end());
  }
  return checked;
}

sim::scenario::Scenario load_checked(const std::string& path,
                                     const std::vector<std::string>& overrides,
                                     const RunMode& mode) {
  CheckedScenario checked =
      check_scenario(hal::files::config::named_file(path, {"scenarios"}), overrides, mode);
  for (const std::string& line : checked.remarks) hal::print_line(hal::Tone::kWarning, line);
  return std::move(checked.scenario);
}

}  // namespace baraka::run::check
