#include "gateway/campaign/slurm_campaign.h"

#include <fmt/format.h>

#include "gateway/campaign/slurm_engine.h"
#include "gateway/exit_status.h"
#include "gateway/run/wall_pace.h"
#include "gateway/slurm/cluster.h"
#include "gateway/slurm/submissions.h"
#include "sim/campaign/campaign_database.h"
#include "sim/campaign/campaign_reader.h"

namespace gateway {
namespace {

using sim::campaign::CampaignDatabase;
using sim::campaign::CampaignReader;

/// Each in a connection of its own: the campaign's one is nobody else's.
slurm::Notes notes_in(const std::filesystem::path& folder) {
  return {.value =
              [folder](std::string_view key) {
                if (!CampaignReader::is_campaign(folder)) return std::string{};
                return CampaignReader(folder).value(key);
              },
          .set = [folder](std::string_view key,
                          std::string_view value) { CampaignDatabase(folder).set(key, value); }};
}

}  // namespace

std::unique_ptr<Engine> slurm_engine(const std::filesystem::path& folder,
                                     const sim::campaign::SlurmSettings& settings,
                                     std::optional<int> at_once) {
  const std::filesystem::path home = std::filesystem::absolute(folder).lexically_normal();
  return std::make_unique<SlurmEngine>(
      SlurmEngine::Settings{.slurm = settings, .at_once = at_once, .folder = home / "slurm"},
      notes_in(home));
}

void require_none_with_slurm(const std::filesystem::path& folder) {
  const slurm::Submissions submissions(notes_in(folder));
  if (submissions.all().empty()) return;
  const auto queue = slurm::Cluster(interrupted).queue(submissions.names());
  if (!queue) {
    throw UsageError(
        fmt::format("{}: runs of this campaign were given to Slurm, and whether it "
                    "still has some cannot be found out: {}",
                    folder.string(), queue.error().message));
  }
  if (queue->empty()) return;
  throw UsageError(
      fmt::format("{}: {} runs of this campaign are with Slurm: go on with "
                  "--engine slurm, or end them with --cancel",
                  folder.string(), queue->size()));
}

int cancel_campaign(const std::filesystem::path& folder) {
  if (!CampaignReader::is_campaign(folder)) {
    throw UsageError(fmt::format("{}: holds no campaign", folder.string()));
  }
  fmt::print("cancelled: {}\n", cancel_slurm_jobs(notes_in(folder)));
  return kDone;
}

}  // namespace gateway
