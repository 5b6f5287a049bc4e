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

/// What the command line of `baraka run` says.
struct RunOptions {
  std::string scenario;
  std::vector<std::string> overrides;  ///< --set, and --seed as one.
  std::optional<double> until;         ///< s
  controllers::ControllersFrom controllers = controllers::ControllersFrom::kSpawn;
  /// Simulated seconds per second. Infinity: as fast as it can, or at 1 if it is shown in a
  /// browser.
  double max_speed = std::numeric_limits<double>::infinity();
  /// "lockstep", "realtime", "realtime:<factor>"; empty: as the scenario needs it.
  std::string pace;
  std::string repeat;  ///< Folder of a run that is to be repeated from its record.
  std::string domain;  ///< "7"; "7-9" for runs side by side; empty: the first free one.
  bool inspect = true;
  std::optional<int> inspect_domain;  ///< None: the run's.
  std::string out;                    ///< Empty: results/<scenario name>.
  bool overwrite = false;             ///< An earlier result there is removed, not kept.
  bool once = false;  ///< A finished result there stays, and another run there is waited for.
  std::optional<int> replications;
  int jobs = 1;              ///< Replications at a time.
  std::string log = "info";  ///< The least that run.log tells of.
  live::LiveViewOptions view{};
};

/// Where the results go. @param scenario  its name.
std::filesystem::path results_path(const RunOptions& options, const std::string& scenario);

/// What of that decides whether a scenario can be run. @throws UsageError  options.pace is none.
check::RunMode run_mode_of(const RunOptions& options);

/// When it ends, as in the table settings: "60 s" or "its end".
std::string until_words(const RunOptions& options);

/// Runs a scenario and prints how it ended, as "key: value" lines on standard output.
/// @return exit status. @throws hal::files::config::ConfigErrors, std::runtime_error
int run(const RunOptions& options);

}  // namespace baraka::run
