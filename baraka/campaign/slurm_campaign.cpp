#include "baraka/campaign/slurm_campaign.h"

#include <fmt/format.h>

#include "baraka/campaign/slurm_engine.h"
#include "baraka/run/pace/interrupts.h"
#include "baraka/slurm/cluster.h"
#include "baraka/slurm/submissions.h"
#include "gateway/process/exit_status.h"
#include "results/campaign/campaign_reader.h"

namespace baraka::campaign {
namespace {

using results::campaign::CampaignDatabase;
using results::campaign::CampaignReader;

/// Notes in the table `campaign`. @param database  must outlive them.
slurm::Notes notes_in(CampaignDatabase& database) {
  return {.value = [&database](std::string_view key) { return database.value(key); },
          .set = [&database](std::string_view key,
                             std::string_view value) { database.set(key, value); }};
}

/// Read-only notes.
slurm::Notes notes_in(CampaignReader& reader) {
  return {.value = [&reader](std::string_view key) { return reader.value(key); }, .set = {}};
}

}  // namespace

EngineMaker slurm_engine(const std::filesystem::path& folder,
                         const results::campaign::SlurmSettings& settings,
                         std::optional<int> at_once) {
  SlurmEngine::require();
  const SlurmEngine::Settings all{
      .slurm = settings,
      .at_once = at_once,
      .folder = std::filesystem::absolute(folder).lexically_normal() / "slurm"};
  return [all](CampaignDatabase& database) {
    return std::make_unique<SlurmEngine>(all, notes_in(database));
  };
}

void require_none_with_slurm(CampaignDatabase& database) {
  const slurm::Submissions submissions(notes_in(database));
  const auto queue = slurm::Cluster(run::pace::interrupted).queue(submissions.names());
  if (!queue) {
    throw gateway::process::UsageError(
        "runs of this campaign were given to Slurm, and whether it still has some "
        "cannot be found out: " +
        queue.error().message);
  }
  if (queue->empty()) return;
  throw gateway::process::UsageError(
      fmt::format("{} runs of this campaign are with Slurm: go on with --engine slurm, "
                  "or end them with --cancel",
                  queue->size()));
}

int cancel_campaign(const std::filesystem::path& folder) {
  if (!CampaignReader::is_campaign(folder)) {
    throw gateway::process::UsageError(fmt::format("{}: holds no campaign", folder.string()));
  }
  CampaignReader reader(folder);
  fmt::print("cancelled: {}\n", cancel_slurm_jobs(notes_in(reader)));
  return gateway::process::kDone;
}

}  // namespace baraka::campaign
