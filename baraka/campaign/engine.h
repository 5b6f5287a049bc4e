#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/time.h"

namespace baraka::campaign {

/// A run of a campaign as an engine sees it: a command and the place of its result.
struct CampaignTask {
  std::int64_t run = 0;  ///< Number in campaign.sqlite.
  std::string name;      ///< For display: "p002-r03".
  /// Arguments of this program: "run", the file of the scenario, "--seed", …; paths are absolute.
  std::vector<std::string> arguments;
  std::filesystem::path folder;  ///< Folder of the result; `baraka run` locks it (FolderLock).
  std::filesystem::path log;     ///< File for the run's output.
};

/// Notice that the process of a run has ended. How the run ended is in its result, if there is one.
struct TaskEnd {
  std::int64_t run = 0;
  std::string cause;             ///< "exited with status 1", "killed by signal 9", "node lost".
  std::string host;              ///< Computer that ran it.
  std::optional<double> wall_s;  ///< Wall time of its process; none: not known.
  std::optional<double> user_s;  ///< Processor time of its processes; none: not known.
};

/// Runs the processes of a campaign, on this computer or elsewhere. The campaign (campaign_loop.h)
/// decides which, collects their results from their folders, and writes the database; an engine
/// does not depend on results or database.
///
///   while (there are runs left) {
///     engine.start(at most engine.room() of them);
///     for (const TaskEnd& end : engine.poll(1s)) collect(end.run);
///   }
///
/// One thread. Errors: std::runtime_error, which ends the campaign; a new process can continue it.
class Engine {
 public:
  Engine() = default;
  virtual ~Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Name as in the table `campaign`: "local", "slurm".
  virtual std::string_view name() const = 0;

  /// To be called once, first. Takes over those runs that are still running or queued, as if
  /// start() had been called for them; the others will be started again.
  /// @param started  runs that an earlier process of this campaign started and that have no result.
  /// @return numbers of the runs taken over.
  virtual std::vector<std::int64_t> adopt(std::span<const CampaignTask> started) = 0;

  /// Number of further tasks that start() accepts now.
  virtual std::size_t room() const = 0;

  /// @pre There is at least one task and at most room(); none of them is under way.
  virtual void start(std::span<const CampaignTask> tasks) = 0;

  /// Number of started tasks that are running, neither queued nor ended.
  virtual std::size_t running() const = 0;

  /// Number of runs that can run at the same time, for estimating the time left.
  virtual std::size_t slots() const = 0;

  /// Waits until some tasks have ended, at most `longest`, or until a signal arrives.
  /// @return the ended tasks, each once.
  virtual std::vector<TaskEnd> poll(hal::Duration longest) = 0;

  /// To be called when the campaign ends before its runs, on an interruption or an error. When it
  /// returns, this process has no run under way; runs may continue elsewhere, see outlives_stop().
  virtual void stop() = 0;

  /// Whether tasks continue after stop(). If so, they are collected only after adopt().
  virtual bool outlives_stop() const { return false; }
};

}  // namespace baraka::campaign
