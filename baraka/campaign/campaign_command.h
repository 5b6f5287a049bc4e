#pragma once

#include "baraka/campaign/campaign_folder.h"
#include "baraka/campaign/campaign_loop.h"
#include "baraka/campaign/engines.h"
#include "baraka/run/run_command.h"
#include "results/campaign/extension.h"

namespace baraka::campaign {

/// Runs a campaign, or what is left of it, and prints how its runs ended: a table of its points and
/// "key: value" lines on standard output.
/// @return exit status: 1 if a run failed, else 3 if one did not meet an expectation; 130.
/// @throws hal::files::config::ConfigErrors, UsageError, std::runtime_error
int run_campaign(const CampaignOptions& options);

/// What `baraka campaign` and `baraka run --replications` have in common: brings a campaign in its
/// folder to its end.
struct CampaignWork {
  results::campaign::WantedRuns wanted;
  CampaignLoop::Settings loop;
};
/// @return exit status.
int do_campaign(const CampaignFolder& folder, const EngineMaker& engine, CampaignWork work);

/// `baraka run --replications N`: a campaign of one point, all of whose folders are kept, and whose
/// failed runs are done again. What is in the folder belongs to one scenario, `--until` and
/// version: `replications.yaml` tells which.
/// @return exit status: of the worst. @throws hal::files::config::ConfigErrors, std::runtime_error
int run_replications(const run::RunOptions& options);

}  // namespace baraka::campaign
