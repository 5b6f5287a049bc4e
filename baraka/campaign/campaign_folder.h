#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "baraka/run/output/folder_lock.h"
#include "results/campaign/rows.h"

namespace baraka::campaign {

/// The folder of a campaign, locked by this process until destruction.
///
///   campaign.sqlite        the plan and all measurements
///   points/p001.yaml       the resolved scenario of each point, which its runs use
///   runs/p001-r01          the result of a run, while it is running or if it is kept
///   runs/p001-r01.log      output of the run
///
/// With Layout::kReplications (`baraka run --replications`) there is one point, its scenario is
/// `replications.yaml`, and the results are directly in the folder: `replication-01`.
class CampaignFolder {
 public:
  enum class Layout : unsigned char { kCampaign, kReplications };
  struct Settings {
    Layout layout = Layout::kCampaign;
    bool overwrite = false;  ///< Remove an earlier result of a single run there.
  };

  /// Sets an earlier result of a single run in the folder aside, as ResultsFolder does.
  /// @throws UsageError  the folder holds something that no run or campaign wrote.
  /// @throws std::runtime_error  another process holds the lock, or the folder cannot be written.
  CampaignFolder(const std::filesystem::path& path, const Settings& settings);

  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path scenario_of(int point) const;
  std::string name_of(const results::campaign::RunPlan& run) const;  ///< "p001-r01".
  std::filesystem::path result_of(const results::campaign::RunPlan& run) const;
  std::filesystem::path log_of(const results::campaign::RunPlan& run) const;

  /// The folder that an ended run left: its result, or the folder of a run that never began.
  std::filesystem::path left_by(const results::campaign::RunPlan& run) const;

  /// Writes the scenario of a point unless it exists.
  /// @throws hal::files::config::ConfigErrors  another scenario is there.
  /// @throws std::runtime_error  it cannot be written.
  void claim(int point, const std::string& scenario) const;

  /// Removes a run's result, the folder of a run that never began, and the run's log.
  void remove(const results::campaign::RunPlan& run) const;
  /// The same without the log.
  void remove_result_of(const results::campaign::RunPlan& run) const;

 private:
  std::filesystem::path path_;
  Layout layout_;
  std::optional<run::output::FolderLock> lock_;
};

}  // namespace baraka::campaign
