#pragma once

#include "gateway/campaign/campaign_folder.h"
#include "gateway/campaign/campaign_loop.h"
#include "gateway/campaign/engines.h"
#include "gateway/run/run_command.h"
#include "sim/campaign/extension.h"

namespace gateway {

/// Runs a campaign, or what is left of it, and prints how its runs ended: a table of its points and
/// "key: value" lines on standard output.
/// @return exit status: 1 if a run failed, else 3 if one did not meet an expectation; 130.
/// @throws hal::config::ConfigErrors, UsageError, std::runtime_error
int run_campaign(const CampaignOptions& options);

/// What `baraka campaign` and `baraka run --replications` have in common: brings a campaign in its
/// folder to its end.
struct CampaignWork {
  sim::campaign::WantedRuns wanted;
  CampaignLoop::Settings loop;
};
/// @return exit status.
int do_campaign(const CampaignFolder& folder, const EngineMaker& engine, CampaignWork work);

/// `baraka run --replications N`: a campaign of one point, all of whose folders are kept, and whose
/// failed runs are done again. What is in the folder belongs to one scenario, `--until` and
/// version: `replications.yaml` tells which.
/// @return exit status: of the worst. @throws hal::config::ConfigErrors, std::runtime_error
int run_replications(const RunOptions& options);

}  // namespace gateway
