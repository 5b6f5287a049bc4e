#include "results/campaign/campaign_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "hal/files/config/document.h"
#include "results/campaign/design_section.h"

namespace results::campaign {
namespace {

using hal::files::config::Mapping;
using hal::files::config::Option;

constexpr std::array kSeeds = {Option<Seeds>{"common", Seeds::kCommon},
                               Option<Seeds>{"independent", Seeds::kIndependent}};
constexpr std::array kKeep = {Option<Keep>{"none", Keep::kNone},
                              Option<Keep>{"failed", Keep::kFailed},
                              Option<Keep>{"all", Keep::kAll}};
constexpr std::array kControllers = {
    Option<RunControllers>{"in-process", RunControllers::kInProcess},
    Option<RunControllers>{"spawn", RunControllers::kSpawn}};

bool is_name(const std::string& name) {
  return std::ranges::all_of(name, [](char c) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    return letter || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

void read_what(Mapping& in, CampaignFile& c, const std::filesystem::path& file) {
  in.integer({"version", "Of the format of this file.", "1"}, 1, 1);
  c.name = in.text({"name",
                    "Of the campaign and of the folder of its results: letters, digits, '_' and "
                    "'-'.",
                    "speeds", "the file's without its ending"},
                   file.stem().string());
  if (!is_name(c.name)) {
    in.mistake("name", fmt::format("'{}' must be letters, digits, '_' and '-'", c.name));
  }
  c.scenario = in.text({"scenario",
                        "The scenario that is run: a file beside this one, or one of those that "
                        "come with BARAKA.",
                        "scenarios/case_study.yaml"});
  c.scenario_place = in.place("scenario");
}

void read_seeds(Mapping& in, CampaignFile& c) {
  c.replications = static_cast<int>(
      in.integer({"replications",
                  "How often each point is run, each time with another seed. More of them extend "
                  "a campaign that has begun.",
                  "10"},
                 1, kMostReplications, 1));
  c.seeds = in.choice({"seeds",
                       "common: replication k has the seed `seed` + k - 1 at every point (common "
                       "random numbers: points differ by what was varied alone); independent: each "
                       "run has one of its own, derived from `seed`, its point's values and k.",
                       "independent"},
                      kSeeds, Seeds::kCommon);
  if (in.has("seed")) {
    c.seed = static_cast<std::uint64_t>(
        in.integer({"seed", "Of replication 1, and of what is sampled.", "1", "the scenario's"}, 0,
                   std::numeric_limits<std::int64_t>::max() - kMostReplications));
  }
}

void read_how(Mapping& in, CampaignFile& c) {
  c.until = in.optional_duration(
      {"until", "Each run ends at this simulated time, as with `--until`; none: at its own end.",
       "60 s"},
      0, std::nullopt);
  c.keep = in.choice({"keep",
                      "Folders of results that stay: of no run (all that is measured is in "
                      "campaign.sqlite), of those that failed, or of all.",
                      "failed"},
                     kKeep, Keep::kNone);
  c.controllers = in.choice({"controllers",
                             "Where controllers run: inside the run's process, which is the "
                             "fastest, or in processes of their own, over DDS. Results are equal.",
                             "spawn"},
                            kControllers, RunControllers::kInProcess);
  if (in.has("jobs")) {
    c.jobs = static_cast<int>(in.integer(
        {"jobs", "Runs at a time on this computer.", "4", "one for each processor"}, 1, 1000));
  }
}

}  // namespace

std::string_view name_of(Design design) {
  switch (design) {
    case Design::kOnePoint:
      return "one point";
    case Design::kGrid:
      return "grid";
    case Design::kList:
      return "list";
    case Design::kLatinHypercube:
      return "latin hypercube";
  }
  return {};
}

std::string_view name_of(Seeds seeds) { return seeds == Seeds::kCommon ? "common" : "independent"; }

CampaignFile read_campaign(Mapping in, const std::filesystem::path& file) {
  CampaignFile campaign;
  read_what(in, campaign, file);
  read_seeds(in, campaign);
  read_design(in, campaign);
  read_how(in, campaign);
  campaign.slurm = read_slurm(in);
  const auto points = campaign.design == Design::kLatinHypercube
                          ? static_cast<std::int64_t>(campaign.samples)
                          : static_cast<std::int64_t>(campaign.points.size());
  if (points * campaign.replications > kMostRuns) {
    in.mistake("replications", fmt::format("{} points times {} are more than the limit of {} runs",
                                           points, campaign.replications, kMostRuns));
  }
  in.finish();
  return campaign;
}

CampaignFile load_campaign(const std::filesystem::path& file,
                           const std::vector<std::string>& overrides) {
  auto document = hal::files::config::Document::load(file, overrides);
  CampaignFile campaign = read_campaign(document.root(), file);
  document.finish();
  return campaign;
}

}  // namespace results::campaign
