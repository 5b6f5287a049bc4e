#pragma once

#include <filesystem>
#include <optional>

#include "baraka/campaign/campaign_options.h"
#include "baraka/campaign/engines.h"
#include "results/campaign/campaign_database.h"
#include "results/campaign/slurm_section.h"

namespace baraka::campaign {

/// What makes the engine of `--engine slurm`, which notes in the table campaign what it submits.
/// @param folder  of the campaign. @param at_once  most runs at a time; none: no limit.
/// @throws UsageError  Slurm's commands are missing, or no cluster answers.
EngineMaker slurm_engine(const std::filesystem::path& folder,
                         const results::campaign::SlurmSettings& settings,
                         std::optional<int> at_once);

/// Before the runs of a campaign are started on this computer.
/// @throws UsageError  Slurm has some of them, or whether it has cannot be found out.
void require_none_with_slurm(results::campaign::CampaignDatabase& database);

/// `baraka campaign FILE --cancel`: ends the jobs of a campaign, and says how many runs they were.
/// @return exit status. @throws UsageError, std::runtime_error
int cancel_campaign(const std::filesystem::path& folder);

}  // namespace baraka::campaign
