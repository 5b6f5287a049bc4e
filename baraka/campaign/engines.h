#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "baraka/campaign/campaign_options.h"
#include "baraka/campaign/engine.h"
#include "results/campaign/campaign_database.h"
#include "results/campaign/campaign_file.h"

namespace baraka::campaign {

/// Makes an engine once the campaign's database is open: what it has to remember of its jobs it
/// keeps in the table campaign. The database outlives the engine.
using EngineMaker = std::function<std::unique_ptr<Engine>(results::campaign::CampaignDatabase&)>;

/// Where the results of a campaign go.
std::filesystem::path campaign_folder(const CampaignOptions& options,
                                      const results::campaign::CampaignFile& file);

/// The engine that `--engine` asks for. Called before anything is written.
/// @throws UsageError  there is none of that name, or it cannot work here.
EngineMaker engine_for(const CampaignOptions& options, const results::campaign::CampaignFile& file);

}  // namespace baraka::campaign
