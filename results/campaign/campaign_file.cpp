#include "results/campaign/campaign_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "hal/files/config/document.h"
#include "hal/files/description/field_io.h"
#include "results/campaign/design_section.h"

namespace results::campaign {
namespace {

using hal::files::config::Mapping;
using hal::files::config::Option;
using hal::files::description::FieldReader;
using hal::files::description::Fields;

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

void what_keys(Fields& io, CampaignFile& c) {
  hal::files::description::needed_version_key(io);
  io.text(
      {"name", "Of the campaign and of the folder of its results: letters, digits, '_' and '-'.",
       "speeds", "the file's without its ending"},
      c.name);
  if (!is_name(c.name))
    io.mistake("name", fmt::format("'{}' must be letters, digits, '_' and '-'", c.name));
  io.needed_text({"scenario",
                  "The scenario that is run: a file beside this one, or one of those that come "
                  "with BARAKA.",
                  "scenarios/case_study.yaml"},
                 c.scenario);
  if (io.reading() != nullptr) c.scenario_place = io.reading()->place("scenario");
}

void seed_keys(Fields& io, CampaignFile& c) {
  io.count({"replications",
            "How often each point is run, each time with another seed. More of them extend a "
            "campaign that has begun.",
            "10"},
           1, kMostReplications, c.replications);
  io.choice({"seeds",
             "common: replication k has the seed `seed` + k - 1 at every point (common random "
             "numbers: points differ by what was varied alone); independent: each run has one of "
             "its own, derived from `seed`, its point's values and k.",
             "independent"},
            kSeeds, c.seeds);
  io.given_count({"seed", "Of replication 1, and of what is sampled.", "1", "the scenario's"}, 0,
                 std::numeric_limits<std::int64_t>::max() - kMostReplications, c.seed);
}

void run_keys(Fields& io, CampaignFile& c) {
  io.optional_duration(
      {"until", "Each run ends at this simulated time, as with `--until`; none: at its own end.",
       "60 s"},
      0, c.until);
  io.choice({"keep",
             "Folders of results that stay: of no run (all that is measured is in "
             "campaign.sqlite), of those that failed, or of all.",
             "failed"},
            kKeep, c.keep);
  io.choice({"controllers",
             "Where controllers run: inside the run's process, which is the fastest, or in "
             "processes of their own, over DDS. Results are equal.",
             "spawn"},
            kControllers, c.controllers);
  io.given_count({"jobs", "Runs at a time on this computer.", "4", "one for each processor"}, 1,
                 1000, c.jobs);
}

void check_size(Fields& io, const CampaignFile& c) {
  const auto points = c.design == Design::kLatinHypercube
                          ? static_cast<std::int64_t>(c.samples)
                          : static_cast<std::int64_t>(c.points.size());
  if (points * c.replications > kMostRuns) {
    io.mistake("replications", fmt::format("{} points times {} are more than the limit of {} runs",
                                           points, c.replications, kMostRuns));
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

void keys_of(Fields& io, CampaignFile& c) {
  what_keys(io, c);
  seed_keys(io, c);
  design_keys(io, c);
  run_keys(io, c);
  slurm_key(io, c.slurm);
  check_size(io, c);
}

CampaignFile read_campaign(Mapping in, const std::filesystem::path& file) {
  CampaignFile campaign;
  campaign.name = file.stem().string();
  FieldReader io(in);
  keys_of(io, campaign);
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
