#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "gateway/campaign/engine.h"
#include "sim/campaign/slurm_section.h"

namespace gateway {

/// The engine of `--engine slurm`. What it submits it notes in the table campaign of the folder's
/// database, from adopt() on.
/// @param folder  of the campaign. @param at_once  most runs at a time; none: no limit.
/// @throws std::runtime_error  the cluster does not answer.
std::unique_ptr<Engine> slurm_engine(const std::filesystem::path& folder,
                                     const sim::campaign::SlurmSettings& settings,
                                     std::optional<int> at_once);

/// Before the runs of a campaign are started on this computer.
/// @throws UsageError  Slurm has some of them, or whether it has cannot be found out.
void require_none_with_slurm(const std::filesystem::path& folder);

/// `baraka campaign FILE --cancel`: ends the jobs of a campaign, and says how many runs they were.
/// @return exit status. @throws UsageError, std::runtime_error
int cancel_campaign(const std::filesystem::path& folder);

}  // namespace gateway
