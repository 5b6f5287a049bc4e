#include "baraka/campaign/slurm_engine.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <set>
#include <stdexcept>
#include <utility>

#include "baraka/run/output/finished_result.h"
#include "baraka/run/output/folder_lock.h"
#include "baraka/run/output/results_folder.h"
#include "baraka/run/pace/interrupts.h"
#include "baraka/slurm/array_job.h"
#include "gateway/process/exit_status.h"
#include "gateway/process/waiting.h"
#include "hal/types/printable.h"

namespace baraka::campaign {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMostQueued = 1'000'000;
constexpr hal::Duration kLongestCancellation = 120s;

hal::Time now() { return gateway::process::wall_clock().now(); }

void write_script(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

std::map<std::pair<std::string, int>, slurm::QueuedTask> by_task(
    const std::vector<slurm::QueuedTask>& queue) {
  std::map<std::pair<std::string, int>, slurm::QueuedTask> places;
  for (const slurm::QueuedTask& task : queue) places[{task.name, task.index}] = task;
  return places;
}

/// Whether a reason for waiting is normal and needs no action by the user.
bool is_ordinary(const std::string& reason) {
  constexpr std::array<std::string_view, 7> kOrdinary{
      "None", "Priority", "Resources", "BeginTime", "JobArrayTaskLimit", "Dependency", "Cleaning"};
  return std::ranges::find(kOrdinary, reason) != kOrdinary.end();
}

std::string in_queue(const slurm::QueuedTask& task) {
  return fmt::format("{}_{}", task.job, task.index);
}

}  // namespace

void SlurmEngine::require() { slurm::Cluster(run::pace::interrupted).require(); }

SlurmEngine::SlurmEngine(Settings settings, slurm::Notes notes)
    : settings_(std::move(settings)),
      submissions_(std::move(notes)),
      cluster_(run::pace::interrupted) {
  const auto index = cluster_.first_bad_index();
  if (!index) throw std::runtime_error(index.error().message);
  first_bad_index_ = *index;
  most_in_one_ = static_cast<std::size_t>(first_bad_index_);
  slots_ = cluster_.processors(settings_.slurm.partition).value_or(1);
  if (settings_.at_once) slots_ = std::min(slots_, *settings_.at_once);
}

std::vector<std::int64_t> SlurmEngine::adopt(std::span<const CampaignTask> started) {
  // Not given up after an interruption, because the message to the user needs the jobs with Slurm.
  const auto queue = slurm::Cluster([] { return false; }).queue(submissions_.names());
  if (!queue) {
    throw std::runtime_error(queue.error().message +
                             "; what runs of this campaign is not known, so none is started");
  }
  std::map<std::int64_t, CampaignTask> ours;
  for (const CampaignTask& task : started) ours[task.run] = task;
  std::vector<std::string> strays;  // tasks whose runs have their results already
  for (const slurm::QueuedTask& place : *queue) {
    const std::int64_t run = submissions_.named(place.name)->first + place.index;
    const auto task = ours.find(run);
    if (task == ours.end() || active_.contains(run)) {
      strays.push_back(in_queue(place));
    } else {
      active_[run] = {task->second, place, std::nullopt};
    }
  }
  if (const auto done = cluster_.cancel(strays); !done) say(done.error().message);
  for (const CampaignTask& task : started) {
    if (!active_.contains(task.run) && run::output::is_held(task.folder)) {
      active_[task.run] = {task, std::nullopt, std::nullopt};
    }
  }
  std::vector<std::int64_t> runs;
  for (const auto& [run, active] : active_) runs.push_back(run);
  return runs;
}

std::size_t SlurmEngine::room() const {
  if (!unsent_.empty()) return 0;
  // Slurm's limit of parallel tasks holds for one array, so only one is submitted at a time.
  if (settings_.at_once) return active_.empty() ? most_in_one_ : 0;
  return kMostQueued - std::min(kMostQueued, active_.size());
}

std::size_t SlurmEngine::running() const {
  return static_cast<std::size_t>(std::ranges::count_if(active_, [](const auto& entry) {
    return !entry.second.place || !entry.second.place->is_waiting();
  }));
}

std::size_t SlurmEngine::slots() const { return static_cast<std::size_t>(std::max(slots_, 1)); }

void SlurmEngine::start(std::span<const CampaignTask> tasks) {
  for (const CampaignTask& task : tasks) {
    std::filesystem::remove(task.log);
    unsent_.push_back(task);
  }
  std::ranges::sort(unsent_, {}, &CampaignTask::run);
  submit_unsent();
}

void SlurmEngine::submit_unsent() {
  while (!unsent_.empty() && now() >= next_try_ && !run::pace::interrupted()) {
    if (settings_.at_once && !active_.empty()) return;
    if (!submit(next_count())) return;
  }
}

/// Number of tasks to submit next: as many as fit into the indices of one array.
std::size_t SlurmEngine::next_count() const {
  const std::size_t most = std::min(most_in_one_, unsent_.size());
  std::size_t count = 1;
  while (count < most && unsent_[count].run - unsent_.front().run < first_bad_index_) ++count;
  return count;
}

/// Submits the next `count` tasks as one array. @return whether to go on submitting.
bool SlurmEngine::submit(std::size_t count) {
  const slurm::Submission submission = submissions_.add(unsent_.front().run);
  run::output::make_folder(settings_.folder);
  slurm::ArrayJob job{.name = submission.name,
                      .program = std::filesystem::read_symlink("/proc/self/exe"),
                      .folder = std::filesystem::current_path(),
                      .log = settings_.folder / (submission.name + ".log"),
                      .at_once = settings_.at_once};
  for (std::size_t i = 0; i < count; ++i) {
    const CampaignTask& task = unsent_[i];
    slurm::Task& one = job.tasks.emplace_back();
    one.index = static_cast<int>(task.run - submission.first);
    one.arguments = task.arguments;
    one.arguments.emplace_back("--once");
    one.log = task.log;
  }
  const std::filesystem::path script = settings_.folder / (submission.name + ".sh");
  write_script(script, slurm::script_of(job));
  const auto number = cluster_.submit(slurm::submission_of(job, settings_.slurm, script));
  if (!number) return cannot_send(count, number.error());
  sent(count, *number);
  return true;
}

void SlurmEngine::sent(std::size_t count, std::int64_t job) {
  submissions_.set_job(job);
  const slurm::Submission& submission = submissions_.all().back();
  for (std::size_t i = 0; i < count; ++i) {
    const CampaignTask& task = unsent_[i];
    const auto index = static_cast<int>(task.run - submission.first);
    active_[task.run] = {task, slurm::QueuedTask{submission.name, job, index, "PENDING", "None"},
                         std::nullopt};
  }
  unsent_.erase(unsent_.begin(), unsent_.begin() + static_cast<std::ptrdiff_t>(count));
  most_in_one_ = std::min(most_in_one_ * 2, static_cast<std::size_t>(first_bad_index_));
}

/// Handles a submission that was refused or not answered. @return whether to go on submitting.
bool SlurmEngine::cannot_send(std::size_t count, const hal::Error& why) {
  next_try_ = now() + settings_.slurm.poll;
  const auto queue = cluster_.queue({submissions_.all().back().name});
  if (!queue) {
    say(queue.error().message + "; asking again");
    return false;
  }
  if (!queue->empty()) {  // Slurm accepted it nevertheless
    sent(count, queue->front().job);
    return true;
  }
  if (count > 1 && !run::pace::interrupted()) {
    most_in_one_ = count / 2;
    next_try_ = now();
    return true;
  }
  const bool is_final = why.code != hal::Errc::kTimeout && active_.empty();
  if (is_final && !run::pace::interrupted()) throw std::runtime_error(why.message);
  say(fmt::format("{}; {} runs wait here", why.message, unsent_.size()));
  return false;
}

std::vector<TaskEnd> SlurmEngine::poll(hal::Duration longest) {
  if (now() < next_look_) {
    gateway::process::wall_clock().wait({}, std::min(longest, next_look_ - now()));
    if (now() < next_look_) return {};
  }
  submit_unsent();
  std::vector<TaskEnd> ends = look();
  next_look_ = now() + settings_.slurm.poll;
  return ends;
}

std::vector<TaskEnd> SlurmEngine::look() {
  std::set<std::string> names;
  for (const auto& [run, active] : active_) {
    if (active.place) names.insert(active.place->name);
  }
  const auto queue = cluster_.queue(names);
  if (!queue) {
    if (!run::pace::interrupted()) say(queue.error().message + "; asking again");
    return {};
  }
  const Places places = by_task(*queue);
  std::vector<TaskEnd> ends;
  for (auto& [run, active] : active_) {
    if (find_again(active, places)) continue;
    if (auto end = end_of(active)) ends.push_back(*std::move(end));
  }
  for (const TaskEnd& end : ends) active_.erase(end.run);
  tell_why_all_wait();
  return ends;
}

/// Updates a task from the queue. @return whether it is in the queue.
bool SlurmEngine::find_again(Active& active, const Places& places) {
  if (!active.place) return false;
  const auto found = places.find({active.place->name, active.place->index});
  if (found == places.end()) return false;
  active.place = found->second;
  active.gone_since.reset();
  return true;
}

/// The end of a task that is not in the queue. None: it has not ended, or its result may not be
/// visible yet.
std::optional<TaskEnd> SlurmEngine::end_of(Active& active) {
  if (run::output::is_held(active.task.folder)) return std::nullopt;
  TaskEnd end{.run = active.task.run, .cause = "lost", .host = "", .wall_s = {}, .user_s = {}};
  if (!active.place) return end;
  const auto job = cluster_.end_of(active.place->job, active.place->index);
  if (job) {
    end.cause = job->in_words();
    end.host = job->node;
    if (job->restarts == 0) end.wall_s = job->wall_s;
  } else {
    end.cause = "lost: Slurm does not know the job any more";
  }
  if (!active.gone_since) active.gone_since = now();
  const bool has_failed = job && !job->has_status(gateway::process::kDone) &&
                          !job->has_status(gateway::process::kExpectationNotMet);
  const bool is_there = run::output::finished_result(active.task.folder).has_value();
  if (is_there || has_failed || now() >= *active.gone_since + settings_.slurm.settle) return end;
  return std::nullopt;
}

void SlurmEngine::tell_why_all_wait() {
  std::set<std::string> reasons;
  for (const auto& [run, active] : active_) {
    if (!active.place || !active.place->is_waiting()) return;
    if (!is_ordinary(active.place->reason)) reasons.insert(active.place->reason);
  }
  for (const std::string& reason : reasons) {
    say(fmt::format("all {} runs wait in the queue: {}", active_.size(), reason));
    break;
  }
}

void SlurmEngine::stop() {
  if (active_.empty()) return;
  std::set<std::int64_t> jobs;
  for (const auto& [run, active] : active_) {
    if (active.place) jobs.insert(active.place->job);
  }
  std::string list;
  for (const std::int64_t job : jobs) list += fmt::format("{}{}", list.empty() ? "" : ", ", job);
  fmt::print(stderr,
             "{} runs stay with Slurm (job {}): repeat the command to continue, --cancel ends "
             "them\n",
             active_.size(), list);
}

void SlurmEngine::say(const std::string& what) {
  if (what == said_) return;
  said_ = what;
  fmt::print(stderr, "slurm: {}\n", hal::printable(what));
}

std::size_t cancel_slurm_jobs(const slurm::Notes& notes) {
  SlurmEngine::require();
  const slurm::Submissions submissions(notes);
  const slurm::Cluster cluster(run::pace::interrupted);
  std::optional<std::size_t> tasks;
  const hal::Time end = now() + kLongestCancellation;
  while (true) {
    const auto queue = cluster.queue(submissions.names());
    if (!queue) throw std::runtime_error(queue.error().message);
    if (!tasks) tasks = queue->size();
    if (queue->empty()) return *tasks;
    if (run::pace::interrupted() || now() > end) {
      throw std::runtime_error(fmt::format("{} runs have not ended yet", queue->size()));
    }
    std::set<std::string> jobs;
    for (const slurm::QueuedTask& task : *queue) jobs.insert(std::to_string(task.job));
    const auto done = cluster.cancel({jobs.begin(), jobs.end()});
    if (!done) throw std::runtime_error(done.error().message);
    gateway::process::wall_clock().wait({}, 500ms);
  }
}

}  // namespace baraka::campaign
