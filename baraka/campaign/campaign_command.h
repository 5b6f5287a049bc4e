#pragma once

#include "baraka/campaign/campaign_folder.h"
#include "baraka/campaign/campaign_loop.h"
#include "baraka/campaign/check_campaign.h"
#include "baraka/campaign/engines.h"
#include "baraka/run/run_command.h"
#include "results/campaign/extension.h"

namespace baraka::campaign {

/// Runs the remaining runs of a campaign and prints how its runs ended: a table of the points and
/// "key: value" lines on standard output.
/// @return exit status: 130 if interrupted, otherwise 1 if a run failed, otherwise 3 if a run did
///   not meet an expectation, otherwise 0.
/// @throws hal::files::config::ConfigErrors, UsageError, std::runtime_error
int run_campaign(const CampaignOptions& options);

/// The same for a campaign that is checked. @param file  whose text is kept in its database.
int run_checked(const CheckedCampaign& campaign, const std::filesystem::path& file,
                const CampaignOptions& options);

/// The common part of `baraka campaign` and `baraka run --replications`: the wanted runs, and how
/// to run them.
struct CampaignWork {
  results::campaign::WantedRuns wanted;
  CampaignLoop::Settings loop;
  bool tells_points = true;  ///< Print a line for each point at the end.
};
/// Plans a campaign in its folder and runs it to its end. @return exit status, as run_campaign().
int do_campaign(const CampaignFolder& folder, const EngineMaker& engine, CampaignWork work);

/// `baraka run --replications N`: a campaign of one point that keeps all result folders and repeats
/// failed runs. All results in its folder have the scenario, `--until` and version that
/// `replications.yaml` names.
/// @return exit status, as run_campaign().
/// @throws hal::files::config::ConfigErrors, std::runtime_error
int run_replications(const run::RunOptions& options);

}  // namespace baraka::campaign
