#include "baraka/campaign/engines.h"

#include <fmt/format.h>

#include "baraka/campaign/local_engine.h"
#include "baraka/campaign/slurm_campaign.h"
#include "gateway/process/exit_status.h"

namespace baraka::campaign {

std::filesystem::path campaign_folder(const CampaignOptions& options,
                                      const results::campaign::CampaignFile& file) {
  return options.out.empty() ? std::filesystem::path("results") / file.name
                             : std::filesystem::path(options.out);
}

EngineMaker engine_for(const CampaignOptions& options,
                       const results::campaign::CampaignFile& file) {
  if (options.engine == "slurm") {
    const std::optional<int> at_once = options.jobs ? options.jobs : file.jobs;
    return slurm_engine(campaign_folder(options, file), file.slurm, at_once);
  }
  if (options.engine != "local") {
    throw gateway::process::UsageError(
        fmt::format("--engine: '{}' is not an engine; there are: local, slurm", options.engine));
  }
  const int jobs = options.jobs.value_or(file.jobs.value_or(usable_processors()));
  return [jobs](results::campaign::CampaignDatabase& database) {
    require_none_with_slurm(database);
    return std::make_unique<LocalEngine>(LocalEngine::Settings{.jobs = jobs, .domains = {}});
  };
}

}  // namespace baraka::campaign
