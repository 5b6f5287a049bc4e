#pragma once

#include <memory>
#include <optional>
#include <string>

#include "baraka/run/network/network_of_run.h"
#include "baraka/run/output/results_folder.h"
#include "baraka/run/run_command.h"
#include "baraka/run/unused_priorities.h"
#include "gateway/process/exit_status.h"
#include "results/record/air_capture.h"
#include "results/record/recorder.h"
#include "sim/agents/fingerprint_feed.h"
#include "sim/agents/simulation.h"
#include "sim/air/ledger.h"
#include "sim/scenario/scenario.h"

namespace baraka::run {

/// The results of one run: their folder, its files, and the observers that write them.
class Results {
 public:
  /// Creates the folder <out>.not-started and sends the log there.
  /// @param pace  from TimeAdvance::pace().
  /// @param held  as for ResultsFolder.
  /// @throws as ResultsFolder.
  Results(const sim::scenario::Scenario& scenario, const RunOptions& options,
          const std::string& pace, std::unique_ptr<output::FolderLock> held);

  /// Marks the run as begun: sets an earlier result aside and starts recording.
  /// @throws std::runtime_error  the tables cannot be created, or as ResultsFolder::begin().
  void begin(sim::agents::Simulation& simulation);

  bool has_begun() const { return recorder_.has_value(); }

  /// Records that the run did not begin. Never throws.
  void say_not_started(const std::string& error);

  /// Makes the record so far readable for other processes.
  void commit();

  /// Records how the run ended. If that cannot be written, the run counts as failed, and as much of
  /// that is recorded as possible. @return exit status.
  gateway::process::ExitStatus finish(const sim::agents::Simulation& simulation,
                                      sim::agents::Outcome& outcome,
                                      gateway::process::ExitStatus status, double wall_seconds);

  /// The account of the use of the air; null: no agent has a network. @pre has_begun()
  const sim::air::Ledger* ledger() const;
  /// To be called after begin(): figures of the networks, reasons to doubt the result, and settings
  /// of a repetition that differ from those of the recorded run.
  void add(const network::NetworkSummary& network);
  void add_warnings(const std::vector<std::string>& lines);
  void add_open_loop(const std::vector<std::string>& lines);

  const output::ResultsFolder& folder() const { return folder_; }
  sim::agents::FingerprintFeed& fingerprint() { return fingerprint_; }
  /// @pre has_begun()
  std::uint64_t frames_digest() const { return recorder_->frames_digest(); }

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
  UnusedPriorities unused_priorities_;
};

}  // namespace baraka::run
