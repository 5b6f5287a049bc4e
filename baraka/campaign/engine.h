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

/// A run of a campaign as an engine sees it: a command, and where its result will be.
struct CampaignTask {
  std::int64_t run = 0;  ///< In campaign.sqlite.
  std::string name;      ///< For people: "p002-r03".
  /// Of this very program: "run", the file of the scenario, "--seed", …; paths are absolute.
  std::vector<std::string> arguments;
  std::filesystem::path folder;  ///< Of its result; `baraka run` locks it (FolderLock).
  std::filesystem::path log;     ///< What it prints goes here.
};

/// The process of a run has ended: how, its result tells, if there is one in its folder.
struct TaskEnd {
  std::int64_t run = 0;
  std::string cause;             ///< "exited with status 1", "killed by signal 9", "node lost".
  std::string host;              ///< Computer that ran it.
  std::optional<double> wall_s;  ///< Of its process; none: not known.
  std::optional<double> user_s;  ///< Processor time of its processes; none: not known.
};

/// Runs the processes of a campaign, here or elsewhere. The campaign (campaign_loop.h) decides
/// which, collects their results from their folders, and writes the database; an engine knows of
/// neither.
///
///   while (there are runs left) {
///     engine.start(as many of them as engine.room() says);
///     for (const TaskEnd& end : engine.poll(1s)) collect(end.run);
///   }
///
/// One thread. Errors: std::runtime_error, which ends the campaign; it can be gone on with.
class Engine {
 public:
  Engine() = default;
  virtual ~Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// As in the table campaign: "local", "slurm".
  virtual std::string_view name() const = 0;

  /// Called once, first: of the runs that an earlier process of this campaign had started and that
  /// have no result, those that are still under way or queued. They are this engine's from now on,
  /// as if start() had been called; the others will be started again.
  /// @return numbers of runs.
  virtual std::vector<std::int64_t> adopt(std::span<const CampaignTask> started) = 0;

  /// How many more tasks it takes now.
  virtual std::size_t room() const = 0;

  /// @pre at most room() of them, at least one; none of them is under way.
  virtual void start(std::span<const CampaignTask> tasks) = 0;

  /// Of those started, how many are under way: not queued, not ended.
  virtual std::size_t running() const = 0;

  /// How many runs it can do at the same time, for the estimate of what is left.
  virtual std::size_t slots() const = 0;

  /// Waits until some have ended, at most so long, or until a signal comes.
  /// @return each ended one once.
  virtual std::vector<TaskEnd> poll(hal::Duration longest) = 0;

  /// The campaign ends before its runs, on an interruption or an error. When it returns, this
  /// process has none under way; whether others have, is the engine's to say (adopt()).
  virtual void stop() = 0;

  /// Whether tasks go on after stop(): then they are collected only after adopt().
  virtual bool outlives_stop() const { return false; }
};

}  // namespace baraka::campaign
