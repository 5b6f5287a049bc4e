#include "baraka/campaign/local_engine.h"

#include <poll.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

#include "baraka/run/output/folder_lock.h"
#include "gateway/process/domains.h"
#include "gateway/process/waiting.h"

namespace baraka::campaign {
namespace {

using namespace std::chrono_literals;

/// Waits for an earlier process of this run to end: one whose parent was just killed may still be
/// ending.
void wait_until_free(const std::filesystem::path& folder) {
  hal::Clock& clock = gateway::process::wall_clock();
  const hal::Time end = clock.now() + 5s;
  while (run::output::is_held(folder) && clock.now() < end) std::this_thread::sleep_for(5ms);
}

}  // namespace

int usable_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::string host_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) {
    throw std::system_error(errno, std::generic_category(), "gethostname");
  }
  return name.data();
}

LocalEngine::LocalEngine(Settings settings)
    : jobs_(settings.jobs), free_domains_(std::move(settings.domains)), host_(host_name()) {}

std::vector<std::int64_t> LocalEngine::adopt(std::span<const CampaignTask> /*started*/) {
  return {};
}

void LocalEngine::start(std::span<const CampaignTask> tasks) {
  for (const CampaignTask& task : tasks) start(task);
}

void LocalEngine::start(const CampaignTask& task) {
  wait_until_free(task.folder);
  std::filesystem::remove(task.log);
  Job& job = running_.emplace_back();
  job.run = task.run;
  std::vector<std::string> arguments = task.arguments;
  if (!free_domains_.empty()) {
    job.domain = free_domains_.back();
    free_domains_.pop_back();
    arguments.insert(arguments.end(), {"--domain", std::to_string(*job.domain)});
  }
  job.started = gateway::process::wall_clock().now();
  try {
    job.process.start({.program = std::filesystem::read_symlink("/proc/self/exe"),
                       .arguments = std::move(arguments),
                       .domain = gateway::process::default_domain(),
                       .log = task.log});
  } catch (...) {
    running_.pop_back();
    throw;
  }
}

std::vector<TaskEnd> LocalEngine::poll(hal::Duration longest) {
  std::vector<pollfd> watched;
  for (const Job& job : running_) watched.push_back({job.process.descriptor(), POLLIN, 0});
  gateway::process::wall_clock().wait(watched, longest);
  std::vector<TaskEnd> ends;
  for (auto job = running_.begin(); job != running_.end();) {
    if (job->process.check()) {
      ++job;
      continue;
    }
    ends.push_back(end_of(*job));
    job = running_.erase(job);
  }
  return ends;
}

TaskEnd LocalEngine::end_of(Job& job) {
  const gateway::process::Ending ending = job.process.stop_all().front();
  if (job.domain) free_domains_.push_back(*job.domain);
  return {.run = job.run,
          .cause = ending.cause,
          .host = host_,
          .wall_s = hal::to_seconds(gateway::process::wall_clock().now() - job.started),
          .user_s = ending.user_s};
}

void LocalEngine::stop() {
  for (const Job& job : running_) job.process.ask_to_end();
  running_.clear();
}

}  // namespace baraka::campaign
