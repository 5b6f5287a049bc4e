#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "baraka/run/output/folder_lock.h"
#include "results/campaign/rows.h"

namespace baraka::campaign {

/// The folder of a campaign, held by this process until destruction.
///
///   campaign.sqlite        what there is to do, and all that was measured
///   points/p001.yaml       the resolved scenario of each point: what its runs run
///   runs/p001-r01          the result of a run, while it is under way or if it is kept
///   runs/p001-r01.log      what it printed
///
/// With Layout::kReplications, of `baraka run --replications`, there is one point, its scenario is
/// `replications.yaml`, and results lie in the folder itself: `replication-01`.
class CampaignFolder {
 public:
  enum class Layout : unsigned char { kCampaign, kReplications };
  struct Settings {
    Layout layout = Layout::kCampaign;
    bool overwrite = false;  ///< Remove an earlier result of a single run there.
  };

  /// An earlier result of a single run in the folder is kept beside it, as ResultsFolder does.
  /// @throws UsageError  it holds what no run or campaign wrote.
  /// @throws std::runtime_error  another process holds it, or it cannot be written.
  CampaignFolder(const std::filesystem::path& path, const Settings& settings);

  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path scenario_of(int point) const;
  std::string name_of(const results::campaign::RunPlan& run) const;  ///< "p001-r01".
  std::filesystem::path result_of(const results::campaign::RunPlan& run) const;
  std::filesystem::path log_of(const results::campaign::RunPlan& run) const;

  /// Where a run that has ended left what there is of it: its result, or the folder of one that
  /// never began.
  std::filesystem::path left_by(const results::campaign::RunPlan& run) const;

  /// Writes the scenario of a point, unless it is there.
  /// @throws hal::files::config::ConfigErrors  another one is there. @throws std::runtime_error
  void claim(int point, const std::string& scenario) const;

  /// Removes what a run left: its result, what it had not begun, and its log.
  void remove(const results::campaign::RunPlan& run) const;
  /// The same, but for its log.
  void remove_result_of(const results::campaign::RunPlan& run) const;

 private:
  std::filesystem::path path_;
  Layout layout_;
  std::optional<run::output::FolderLock> lock_;
};

}  // namespace baraka::campaign
