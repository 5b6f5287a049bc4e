#include "gateway/campaign/engines.h"

#include <fmt/format.h>

#include "gateway/campaign/local_engine.h"
#include "gateway/campaign/slurm_campaign.h"
#include "gateway/exit_status.h"

namespace gateway {

std::filesystem::path campaign_folder(const CampaignOptions& options,
                                      const sim::campaign::CampaignFile& file) {
  return options.out.empty() ? std::filesystem::path("results") / file.name
                             : std::filesystem::path(options.out);
}

EngineMaker engine_for(const CampaignOptions& options, const sim::campaign::CampaignFile& file) {
  if (options.engine == "slurm") {
    const std::optional<int> at_once = options.jobs ? options.jobs : file.jobs;
    return slurm_engine(campaign_folder(options, file), file.slurm, at_once);
  }
  if (options.engine != "local") {
    throw UsageError(
        fmt::format("--engine: '{}' is no engine; there are: local, slurm", options.engine));
  }
  const int jobs = options.jobs.value_or(file.jobs.value_or(usable_processors()));
  return [jobs](sim::campaign::CampaignDatabase& database) {
    require_none_with_slurm(database);
    return std::make_unique<LocalEngine>(LocalEngine::Settings{.jobs = jobs, .domains = {}});
  };
}

}  // namespace gateway
