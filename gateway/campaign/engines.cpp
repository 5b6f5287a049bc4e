#include "gateway/campaign/engines.h"

#include <fmt/format.h>

#include "gateway/campaign/local_engine.h"
#include "gateway/exit_status.h"

namespace gateway {

EngineMaker engine_for(const CampaignOptions& options, const sim::campaign::CampaignFile& file) {
  if (options.engine != "local") {
    throw UsageError(fmt::format("--engine: '{}' is no engine; there is: local", options.engine));
  }
  const int jobs = options.jobs.value_or(file.jobs.value_or(usable_processors()));
  return [jobs](sim::campaign::CampaignDatabase& /*database*/) {
    return std::make_unique<LocalEngine>(LocalEngine::Settings{.jobs = jobs, .domains = {}});
  };
}

}  // namespace gateway
