#pragma once

#include <memory>
#include <optional>
#include <string>

#include "baraka/run/network/network_of_run.h"
#include "baraka/run/output/results_folder.h"
#include "baraka/run/run_command.h"
#include "gateway/process/exit_status.h"
#include "results/record/air_capture.h"
#include "results/record/recorder.h"
#include "sim/agents/fingerprint_feed.h"
#include "sim/agents/simulation.h"
#include "sim/air/ledger.h"
#include "sim/scenario/scenario.h"

namespace baraka::run {

/// The results of one run: their folder, what is written there, and the observers that write it.
class Results {
 public:
  /// From now on the log goes to the folder of what has not begun.
  /// @throws as ResultsFolder.
  /// @param pace  as TimeAdvance::pace().
  /// @param held  as for ResultsFolder.
  Results(const sim::scenario::Scenario& scenario, const RunOptions& options,
          const std::string& pace, std::unique_ptr<output::FolderLock> held);

  /// The run begins: from now on it is recorded, and an earlier result is no longer in its place.
  /// @throws std::runtime_error  the tables cannot be made, or as ResultsFolder::begin().
  void begin(sim::agents::Simulation& simulation);

  bool has_begun() const { return recorder_.has_value(); }

  /// The run did not come to begin(): the folder says so. Never throws.
  void say_not_started(const std::string& error);

  /// Makes what there is so far readable for others.
  void commit();

  /// Writes how the run ended; if that cannot be written, it becomes a failed one, and as much of
  /// that as can be. @return exit status.
  gateway::process::ExitStatus finish(const sim::agents::Simulation& simulation,
                                      sim::agents::Outcome& outcome,
                                      gateway::process::ExitStatus status, double wall_seconds);

  /// What the air is used for; null: no agent has a network. @pre has_begun()
  const sim::air::Ledger* ledger() const;
  /// After begin(): how its networks were, what speaks against the result, and what of a repetition
  /// is not as it was.
  void add(const network::NetworkSummary& network);
  void add_warnings(const std::vector<std::string>& lines);
  void add_open_loop(const std::vector<std::string>& lines);

  const output::ResultsFolder& folder() const { return folder_; }
  sim::agents::FingerprintFeed& fingerprint() { return fingerprint_; }

 private:
  void record(const std::filesystem::path& folder);
  void capture(sim::agents::Simulation& simulation);
  void observe(sim::agents::Simulation& simulation);
  void give_up(const sim::agents::Outcome& outcome, gateway::process::ExitStatus status);

  const sim::scenario::Scenario& scenario_;
  std::string pace_;
  std::vector<std::pair<std::string, std::string>> settings_;
  output::ResultsFolder folder_;
  std::optional<results::record::Recorder> recorder_;
  std::optional<results::record::AirCapture> capture_;
  sim::agents::FingerprintFeed fingerprint_;
};

}  // namespace baraka::run
