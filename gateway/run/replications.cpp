#include "gateway/run/replications.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <list>
#include <map>
#include <stdexcept>
#include <thread>
#include <vector>

#include "gateway/exit_status.h"
#include "gateway/run/domain_range.h"
#include "gateway/run/judge_controllers.h"
#include "gateway/run/replication_progress.h"
#include "gateway/run/replications_folder.h"
#include "gateway/run/wall_pace.h"
#include "gateway/spawn.h"
#include "hal/config/errors.h"
#include "hal/dds/domains.h"
#include "hal/types/printable.h"
#include "sim/scenario/resolved.h"

namespace gateway {
namespace {

using namespace std::chrono_literals;
using Clock = ReplicationProgress::Clock;

/// Whether running it again would tell nothing new.
bool is_final(const ReplicationEnd& end) {
  return end.status == kDone || end.status == kExpectationNotMet;
}

void check_options(const RunOptions& options, std::uint64_t seed) {
  std::vector<std::string> mistakes;
  const auto last = static_cast<std::uint64_t>(*options.replications) - 1;
  if (seed > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()) - last) {
    mistakes.push_back(
        fmt::format("--replications: from seed {}, there are no {} seeds", seed, last + 1));
  }
  if (options.jobs > 1 && options.controllers == ControllersFrom::kExternal) {
    mistakes.push_back(
        "--jobs: runs side by side need controllers of their own, so no --controllers external");
  }
  if (!mistakes.empty()) throw hal::config::ConfigErrors(std::move(mistakes));
}

/// What `baraka` is started with for one replication.
std::vector<std::string> arguments_for(const RunOptions& options, const ReplicationsFolder& folder,
                                       const Replication& replication, std::optional<int> domain) {
  constexpr const char* kFrom[] = {"spawn", "external", "in-process"};
  std::vector<std::string> arguments{"run",           folder.scenario().string(),
                                     "--seed",        std::to_string(replication.seed),
                                     "--out",         (folder.path() / replication.name()).string(),
                                     "--controllers", kFrom[static_cast<int>(options.controllers)],
                                     "--overwrite"};  // of one that was cut short
  const auto add = [&](const char* option, const std::string& value) {
    arguments.insert(arguments.end(), {option, value});
  };
  if (options.until) add("--until", fmt::format("{}", *options.until));
  if (std::isfinite(options.max_speed)) add("--max-speed", fmt::format("{}", options.max_speed));
  if (domain) add("--domain", std::to_string(*domain));
  add("--log", options.log);
  if (options.inspect_domain) add("--inspect-domain", std::to_string(*options.inspect_domain));
  if (!options.inspect) arguments.emplace_back("--no-inspect");
  return arguments;
}

/// The processes of the replications.
class Replicator {
 public:
  Replicator(const RunOptions& options, const ReplicationsFolder& folder,
             const std::vector<Replication>& replications);

  /// Until all have ended or the user interrupts.
  void run();

  /// As "key: value" lines, and those that failed for people. @return exit status.
  int print_outcome() const;

 private:
  struct Job {
    Replication replication;
    std::optional<int> domain;  ///< None: it takes a free one.
    Spawner process;
  };

  void start(const Replication& replication);
  void collect();
  void finish(Job& job);

  const RunOptions& options_;
  const ReplicationsFolder& folder_;
  std::vector<Replication> replications_;
  std::deque<Replication> waiting_;
  std::vector<int> free_domains_;  ///< Of those that the user gave.
  std::list<Job> running_;
  std::map<int, ReplicationEnd> ends_;  ///< By number.
  std::size_t kept_ = 0;
  ReplicationProgress progress_;
  Clock::time_point begin_ = Clock::now();
};

Replicator::Replicator(const RunOptions& options, const ReplicationsFolder& folder,
                       const std::vector<Replication>& replications)
    : options_(options),
      folder_(folder),
      replications_(replications),
      free_domains_(domains_for(options.domain, options.jobs)),
      progress_(0, 1, false) {
  for (const Replication& replication : replications_) {
    const auto end = folder_.end_of(replication);
    if (end && is_final(*end)) {
      ends_[replication.number] = *end;
    } else {
      waiting_.push_back(replication);
    }
  }
  kept_ = ends_.size();
  progress_ = {static_cast<int>(waiting_.size()), options.jobs, ::isatty(STDERR_FILENO) != 0};
  if (kept_ > 0) fmt::print(stderr, "{} had ended before\n", kept_);
}

void Replicator::run() {
  while (!(waiting_.empty() && running_.empty()) && !interrupted()) {
    while (!waiting_.empty() && static_cast<int>(running_.size()) < options_.jobs) {
      start(waiting_.front());
      waiting_.pop_front();
    }
    progress_.show(Clock::now());
    std::this_thread::sleep_for(20ms);
    collect();
  }
  progress_.end();
  for (Job& job : running_) {
    job.process.stop_all();
    // Some may have ended in the same moment.
    const auto end = folder_.end_of(job.replication);
    if (end && is_final(*end)) ends_[job.replication.number] = *end;
  }
  running_.clear();
}

void Replicator::start(const Replication& replication) {
  // One whose parent was killed a moment ago may still be about to die.
  const auto end = Clock::now() + 5s;
  while (is_held(folder_.path() / replication.name()) && Clock::now() < end) {
    std::this_thread::sleep_for(20ms);
  }
  const std::filesystem::path log = folder_.path() / (replication.name() + ".log");
  std::filesystem::remove(log);
  Job& job = running_.emplace_back();
  job.replication = replication;
  if (!free_domains_.empty()) {
    job.domain = free_domains_.back();
    free_domains_.pop_back();
  }
  job.process.start({.program = std::filesystem::read_symlink("/proc/self/exe"),
                     .arguments = arguments_for(options_, folder_, replication, job.domain),
                     .domain = hal::dds::default_domain(),
                     .log = log});
  progress_.on_start(replication, Clock::now());
}

void Replicator::collect() {
  for (auto job = running_.begin(); job != running_.end();) {
    if (job->process.check()) {
      ++job;
    } else {
      finish(*job);
      if (job->domain) free_domains_.push_back(*job->domain);
      job = running_.erase(job);
    }
  }
}

void Replicator::finish(Job& job) {
  const Ending ending = job.process.stop_all().front();
  ReplicationEnd end =
      folder_.end_of(job.replication).value_or(ReplicationEnd{kRunFailed, "failed", ""});
  if (!is_final(end)) {
    end.status = kRunFailed;
    const std::string words = folder_.last_words(job.replication);
    if (end.error.empty()) end.error = ending.cause + (words.empty() ? "" : ": " + words);
  }
  progress_.on_end(job.replication, end, Clock::now());
  ends_[job.replication.number] = end;
}

void print_bad_end(const Replication& replication, const ReplicationEnd& end) {
  fmt::print(stderr, "{}: {} (seed {}): {}\n", is_final(end) ? "expectation not met" : "failed",
             replication.name(), replication.seed,
             hal::printable(is_final(end) ? end.result : end.error));
}

int Replicator::print_outcome() const {
  std::map<std::string, int> results;
  std::size_t failed = 0, unmet = 0;
  for (const Replication& replication : replications_) {
    const auto found = ends_.find(replication.number);
    if (found == ends_.end()) continue;
    const ReplicationEnd& end = found->second;
    if (is_final(end)) ++results[end.result];
    if (end.status == kDone) continue;
    ++(is_final(end) ? unmet : failed);
    print_bad_end(replication, end);
  }
  fmt::print("replications: {}\nfinished: {}\nfailed: {}\nkept: {}\n", replications_.size(),
             ends_.size() - failed, failed, kept_);
  for (const auto& [result, count] : results) fmt::print("result {}: {}\n", result, count);
  fmt::print("wall_s: {:.3f}\n", std::chrono::duration<double>(Clock::now() - begin_).count());
  fmt::print("results: {}\n", folder_.path().string());
  if (ends_.size() < replications_.size()) {
    fmt::print(stderr, "interrupted; the same command goes on from here\n");
    return kInterrupted;
  }
  if (failed > 0) return kRunFailed;
  return unmet > 0 ? kExpectationNotMet : kDone;
}

}  // namespace

int run_replications(const RunOptions& options) {
  const sim::scenario::Scenario scenario = load_judged(options.scenario, options.overrides);
  const std::uint64_t seed = scenario.simulation.seed;
  check_options(options, seed);
  (void)domains_for(options.domain, options.jobs);  // before anything is written
  std::vector<Replication> replications;
  for (int k = 1; k <= *options.replications; ++k) {
    replications.push_back({k, seed + static_cast<std::uint64_t>(k) - 1});
  }
  catch_interrupts();
  const ReplicationsFolder folder(
      results_path(options, scenario.name),
      {sim::scenario::resolved_yaml(scenario), options.until, options.overwrite});
  Replicator replicator(options, folder, replications);
  replicator.run();
  return replicator.print_outcome();
}

}  // namespace gateway
