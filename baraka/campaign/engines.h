#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "baraka/campaign/campaign_options.h"
#include "baraka/campaign/engine.h"
#include "results/campaign/campaign_database.h"
#include "results/campaign/campaign_file.h"

namespace baraka::campaign {

/// Creates an engine when the campaign's database is open. The engine may keep notes about its jobs
/// in the table `campaign`. The database must outlive the engine.
using EngineMaker = std::function<std::unique_ptr<Engine>(results::campaign::CampaignDatabase&)>;

/// The folder of a campaign's results.
std::filesystem::path campaign_folder(const CampaignOptions& options,
                                      const results::campaign::CampaignFile& file);

/// The engine named by `--engine`. To be called before anything is written.
/// @throws UsageError  there is no engine of that name, or it cannot work here.
EngineMaker engine_for(const CampaignOptions& options, const results::campaign::CampaignFile& file);

}  // namespace baraka::campaign
