#include "baraka/campaign/campaign_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>

#include "baraka/campaign/campaign_status.h"
#include "baraka/campaign/check_campaign.h"
#include "baraka/campaign/program_digests.h"
#include "baraka/campaign/slurm_campaign.h"
#include "baraka/run/output/results_folder.h"
#include "baraka/run/pace/interrupts.h"
#include "gateway/process/exit_status.h"
#include "hal/files/config/errors.h"
#include "hal/files/config/shared_folders.h"
#include "hal/types/terminal_colours.h"
#include "results/campaign/schema.h"
#include "sim/scenario/plot_request.h"

namespace baraka::campaign {
namespace {

namespace fs = std::filesystem;

using results::campaign::CampaignDatabase;
using results::campaign::CampaignFile;
using results::campaign::CampaignReader;
using results::campaign::PointRow;
using results::campaign::WantedRuns;
using Clock = std::chrono::steady_clock;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string until_words(const CampaignFile& file) {
  return file.until ? fmt::format("{} s", hal::to_seconds(*file.until)) : "its end";
}

WantedRuns wanted_by(const CheckedCampaign& campaign, const fs::path& path) {
  const CampaignFile& file = campaign.file;
  const bool in_process = file.controllers == results::campaign::RunControllers::kInProcess;
  WantedRuns wanted{.values = {{"name", file.name},
                               {"version", BARAKA_VERSION},
                               {"scenario", file.scenario},
                               {"design", std::string(name_of(file.design))},
                               {"base_seed", std::to_string(campaign.seed)},
                               {"replications", std::to_string(file.replications)},
                               {"seeds", std::string(name_of(file.seeds))},
                               {"until", until_words(file)},
                               {"controllers", in_process ? "in-process" : "spawn"},
                               {"pace", file.pace},
                               {"programs", program_digests(campaign.controllers, campaign.files)},
                               {"file", text_of(path)}},
                    .factors = campaign.table.factors,
                    .points = campaign.table.points,
                    .replications = file.replications,
                    .seeds = file.seeds,
                    .base_seed = campaign.seed,
                    .essence = sim::scenario::without_report_only};
  if (file.samples > 0) wanted.values.emplace_back("sampled", std::to_string(file.samples));
  return wanted;
}

std::vector<std::string> run_arguments(const CampaignFile& file) {
  const bool in_process = file.controllers == results::campaign::RunControllers::kInProcess;
  std::vector<std::string> arguments{"--controllers", in_process ? "in-process" : "spawn",
                                     "--no-inspect", "--pace", file.pace};
  if (file.until) {
    arguments.insert(arguments.end(), {"--until", fmt::format("{}", hal::to_seconds(*file.until))});
  }
  return arguments;
}

/// The folder of a campaign's results, without checking the campaign's points.
fs::path folder_of(const CampaignOptions& options) {
  if (!options.out.empty()) return options.out;
  const fs::path file = hal::files::config::named_file(options.file, {"campaigns"});
  return fs::path("results") / results::campaign::load_campaign(file, options.overrides).name;
}

void print_counts(const CampaignStatus& status, const CampaignFolder& folder, std::size_t kept,
                  Clock::time_point begin) {
  const bool is_one_point = fs::exists(folder.path() / run::output::kReplicationsFile);
  if (is_one_point) fmt::print("replications: {}\n", status.runs);
  if (!is_one_point) {
    fmt::print("{}points: {}\nruns: {}\n", status.table, status.points, status.runs);
  }
  fmt::print("finished: {}\nfailed: {}\nkept: {}\n", status.done, status.failed, kept);
  for (const auto& [result, count] : status.results) fmt::print("result {}: {}\n", result, count);
  fmt::print("wall_s: {:.3f}\n", std::chrono::duration<double>(Clock::now() - begin).count());
  fmt::print("results: {}\n", folder.path().string());
}

/// While other programs read the database, nothing can be written. The campaign waits for them, and
/// prints a notice once each time.
class WaitForReaders {
 public:
  explicit WaitForReaders(fs::path folder) : folder_(std::move(folder)) {}

  bool operator()(double waited_s) {
    if (waited_s == 0) said_ = false;
    if (waited_s >= kPatience && !std::exchange(said_, true)) {
      fmt::print(stderr, "{}waiting: another program is reading {}; the runs go on\n",
                 ::isatty(STDERR_FILENO) != 0 ? "\r\033[K" : "",
                 (folder_ / results::campaign::kCampaignDatabase).string());
    }
    return waited_s < kPatience || !run::pace::interrupted();
  }

 private:
  static constexpr double kPatience = 5;  // s
  fs::path folder_;
  bool said_ = false;
};

constexpr const char* kGoOn = "repeat the command to continue";

/// Adds new points and runs to the database, and writes the scenario file of each point.
void plan(const CampaignFolder& folder, CampaignDatabase& database, const WantedRuns& wanted) {
  CampaignReader reader(folder.path());
  const results::campaign::Extension more = results::campaign::extension(wanted, reader);
  database.add(more.plan);
  if (!more.said.empty()) fmt::print(stderr, "the campaign has {}\n", more.said);
  for (const PointRow& point : CampaignReader(folder.path()).points()) {
    if (fs::exists(folder.path() / run::output::kReplicationsFile)) break;  // written already
    folder.claim(point.point, point.scenario);
  }
}

int outcome(const CampaignStatus& status) {
  if (status.done + status.failed < status.runs) {
    fmt::print(stderr, "interrupted; {}\n", kGoOn);
    return gateway::process::kInterrupted;
  }
  if (status.failed > 0) return gateway::process::kRunFailed;
  return status.unmet > 0 ? gateway::process::kExpectationNotMet : gateway::process::kDone;
}

}  // namespace

int do_campaign(const CampaignFolder& folder, const EngineMaker& make_engine, CampaignWork work) {
  const auto begin = Clock::now();
  const int replications = work.wanted.replications;
  std::size_t kept = 0;
  try {
    CampaignDatabase database(folder.path(), WaitForReaders(folder.path()));
    // Only after the database exists: it identifies the folder after a kill.
    if (!fs::exists(folder.path() / run::output::kReplicationsFile))
      run::output::make_folder(folder.path() / "runs");
    const std::unique_ptr<Engine> engine = make_engine(database);
    work.wanted.values.emplace_back("engine", engine->name());
    plan(folder, database, work.wanted);
    work.loop.replications = replications;
    work.loop.progress.terminal = ::isatty(STDERR_FILENO) != 0;
    work.loop.progress.slots = engine->slots();
    CampaignLoop loop({database, folder, *engine}, std::move(work.loop));
    kept = loop.kept();
    if (kept > 0) fmt::print(stderr, "{} had ended before\n", kept);
    loop.run();
  } catch (const hal::files::config::ConfigErrors&) {
    throw;
  } catch (const gateway::process::UsageError&) {
    throw;
  } catch (const DiskFull& e) {
    throw std::runtime_error(
        fmt::format("the disk is full, no more runs are started: {}; {}", e.what(), kGoOn));
  } catch (const std::exception& e) {
    throw std::runtime_error(fmt::format("{}; {}", e.what(), kGoOn));
  }
  CampaignReader reader(folder.path());
  CampaignStatus status = status_of(reader, replications);
  if (!work.tells_points) status.table.clear();
  fmt::print(stderr, "{}", status.bad_ends);
  print_counts(status, folder, kept, begin);
  return outcome(status);
}

int run_campaign(const CampaignOptions& options) {
  if (options.status) return print_status(folder_of(options));
  if (options.cancel) return cancel_campaign(folder_of(options));
  return run_checked(check_campaign(options.file, options.overrides),
                     hal::files::config::named_file(options.file, {"campaigns"}), options);
}

int run_checked(const CheckedCampaign& campaign, const fs::path& file,
                const CampaignOptions& options) {
  for (const std::string& warning : campaign.warnings) {
    hal::print_line(hal::Tone::kWarning, warning);
  }
  const EngineMaker engine = engine_for(options, campaign.file);
  run::pace::catch_interrupts();
  const fs::path out =
      options.out.empty() ? fs::path("results") / campaign.file.name : fs::path(options.out);
  const CampaignFolder folder(
      out, {.layout = CampaignFolder::Layout::kCampaign, .overwrite = options.overwrite});
  CampaignWork work{.wanted = wanted_by(campaign, file), .loop = {}};
  work.tells_points = options.tells_points;
  work.loop.keep = campaign.file.keep;
  work.loop.retry_failed = options.retry_failed;
  work.loop.run_arguments = run_arguments(campaign.file);
  return do_campaign(folder, engine, std::move(work));
}

}  // namespace baraka::campaign
