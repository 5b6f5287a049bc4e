#include "results/campaign/campaign_file.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "hal/files/config/document.h"
#include "hal/files/description/field_io.h"
#include "hal/files/description/names.h"
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

void what_keys(Fields& io, CampaignFile& c) {
  hal::files::description::needed_version_key(io);
  io.text({"name", "Name of the campaign and of its results folder: letters, digits, '_' and '-'.",
           "speeds", "the file's name without its ending"},
          c.name);
  hal::files::description::check_folder_name(io, c.name);
  io.needed_text({"scenario",
                  "Scenario to run: a file whose path is relative to this one, or a scenario that "
                  "comes with BARAKA.",
                  "scenarios/case_study.yaml"},
                 c.scenario);
  if (io.reading() != nullptr) c.scenario_place = io.reading()->place("scenario");
}

void seed_keys(Fields& io, CampaignFile& c) {
  io.count({"replications",
            "Number of runs at each point, each with another seed. Increasing it extends a "
            "campaign that has begun.",
            "10"},
           1, kMostReplications, c.replications);
  io.choice(
      {"seeds",
       "Seeds of the replications. common: replication k has the seed `seed` + k - 1 at every "
       "point (common random numbers), so points differ only in what is varied; independent: each "
       "run has its own, derived from `seed`, the values of its point, and k.",
       "independent"},
      kSeeds, c.seeds);
  io.given_count({"seed", "Seed of replication 1 and of `sample`.", "1", "the scenario's"}, 0,
                 std::numeric_limits<std::int64_t>::max() - kMostReplications, c.seed);
}

void run_keys(Fields& io, CampaignFile& c) {
  io.optional_duration(
      {"until",
       "Simulated time at which each run ends, as with `--until`; none: as the scenario says.",
       "60 s"},
      0, c.until);
  io.choice({"keep",
             "Runs whose results folders are kept. none: of no run, since all that is measured is "
             "in campaign.sqlite; failed: of runs that failed; all.",
             "failed"},
            kKeep, c.keep);
  io.choice({"controllers",
             "Where controllers run. in-process: in the process of the run, which is fastest; "
             "spawn: in processes of their own, over DDS. The results are equal. A scenario with a "
             "controller `inside` its agent's network is always run with spawn.",
             "spawn"},
            kControllers, c.controllers);
  io.text({"pace",
           "How simulated time advances in the runs, as with `--pace`. lockstep: controllers are "
           "waited for and programs held, so that runs of equal seeds are equal; realtime[:F]: it "
           "follows the wall clock, F times as fast, and runs of equal seeds differ.",
           "realtime:0.5"},
          c.pace);
  if (io.reading() != nullptr) c.pace_place = io.reading()->place("pace");
  io.given_count(
      {"jobs", "Number of simultaneous runs on this computer.", "4", "one for each processor"}, 1,
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
