#pragma once

#include <filesystem>
#include <optional>

#include "baraka/campaign/campaign_options.h"
#include "baraka/campaign/engines.h"
#include "results/campaign/campaign_database.h"
#include "results/campaign/slurm_section.h"

namespace baraka::campaign {

/// Creates the engine of `--engine slurm`, which notes its submissions in the table `campaign`.
/// @param folder  of the campaign.
/// @param at_once  most parallel runs; none: no limit.
/// @throws UsageError  Slurm's commands are missing, or no cluster answers.
EngineMaker slurm_engine(const std::filesystem::path& folder,
                         const results::campaign::SlurmSettings& settings,
                         std::optional<int> at_once);

/// To be called before runs of a campaign are started on this computer.
/// @throws UsageError  some of its runs are with Slurm, or this cannot be determined.
void require_none_with_slurm(results::campaign::CampaignDatabase& database);

/// `baraka campaign FILE --cancel`: ends the jobs of a campaign and prints their number of runs.
/// @return exit status. @throws UsageError, std::runtime_error
int cancel_campaign(const std::filesystem::path& folder);

}  // namespace baraka::campaign
