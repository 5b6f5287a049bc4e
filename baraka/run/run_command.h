#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "baraka/run/check/check_controllers.h"
#include "baraka/run/controllers/controllers_of_run.h"
#include "baraka/run/live/live_view.h"

namespace baraka::run {

/// The command line of `baraka run`.
struct RunOptions {
  std::string scenario;
  std::vector<std::string> overrides;  ///< Values of --set, with --seed as one of them.
  std::optional<double> until;         ///< s
  controllers::ControllersFrom controllers = controllers::ControllersFrom::kSpawn;
  /// Simulated seconds per second. Infinity: as fast as possible, or 1 if the run is shown in a
  /// browser.
  double max_speed = std::numeric_limits<double>::infinity();
  /// "lockstep", "realtime", "realtime:<factor>"; empty: as the scenario requires.
  std::string pace;
  std::string repeat;  ///< Folder of a recorded run to repeat.
  std::string domain;  ///< "7"; "7-9" for parallel runs; empty: the first free domain.
  bool inspect = true;
  std::optional<int> inspect_domain;  ///< None: the domain of the run.
  std::string out;                    ///< Empty: results/<scenario name>.
  bool overwrite = false;             ///< Remove an earlier result there instead of keeping it.
  bool once = false;  ///< Keep a finished result there, and wait for a run that is writing there.
  std::optional<int> replications;
  int jobs = 1;              ///< Number of parallel replications.
  std::string log = "info";  ///< Lowest level written to run.log.
  live::LiveViewOptions view{};
};

/// The folder of the results. @param scenario  name of the scenario.
std::filesystem::path results_path(const RunOptions& options, const std::string& scenario);

/// The options that decide whether a scenario can be run.
/// @throws UsageError  options.pace is not a valid pace.
check::RunMode run_mode_of(const RunOptions& options);

/// The value of `--until` as in the table `settings`: "60 s" or "its end".
std::string until_words(const RunOptions& options);

/// Runs a scenario and prints how it ended, as "key: value" lines on standard output.
/// @return exit status. @throws hal::files::config::ConfigErrors, std::runtime_error
int run(const RunOptions& options);

}  // namespace baraka::run
