#include "baraka/slurm/cluster.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "baraka/slurm/program.h"
#include "gateway/process/exit_status.h"
#include "gateway/process/find_program.h"

namespace baraka::slurm {
namespace {

using namespace std::chrono_literals;

constexpr hal::Duration kLongest = 60s;
constexpr int kUsualFirstBadIndex = 1001;

/// Message of sbatch before it tries again by itself, for minutes.
bool tries_again(const Printed& printed) {
  return printed.err.find("retrying") != std::string::npos;
}

std::vector<std::filesystem::path> folders_of_path() {
  const char* const path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe)
  std::istringstream folders(path == nullptr ? "" : path);
  std::vector<std::filesystem::path> found;
  for (std::string folder; std::getline(folders, folder, ':');) found.emplace_back(folder);
  return found;
}

}  // namespace

hal::Result<std::string> Cluster::answer(const std::vector<std::string>& command) const {
  const auto printed = run_program(command, kLongest, [this](const Printed& so_far) {
    return interrupted_() || tries_again(so_far);
  });
  if (!printed) return tl::unexpected(printed.error());
  if (printed->status == 0) return printed->out;
  return hal::fail(hal::Errc::kNotAvailable,
                   fmt::format("{}: {}", command[0], printed->last_errors()));
}

void Cluster::require() const {
  for (const char* name : {"sbatch", "squeue", "scontrol", "scancel"}) {
    if (gateway::process::find_program(name, folders_of_path())) continue;
    throw gateway::process::UsageError(fmt::format(
        "--engine slurm: Slurm's {} is in no folder of PATH (Debian: slurm-client)", name));
  }
  const auto ping = answer({"scontrol", "ping"});
  if (!ping)
    throw gateway::process::UsageError("--engine slurm: no cluster answers: " +
                                       ping.error().message);
}

hal::Result<int> Cluster::first_bad_index() const {
  const auto config = answer({"scontrol", "show", "config"});
  if (!config) return tl::unexpected(config.error());
  const std::string text = parse_config(*config, "MaxArraySize").value_or("");
  int index = kUsualFirstBadIndex;
  (void)std::from_chars(text.data(), text.data() + text.size(), index);
  return std::max(index, 1);
}

std::optional<int> Cluster::processors(const std::string& partition) const {
  std::vector<std::string> command{"sinfo", "--noheader", "--format=%C"};
  if (!partition.empty()) command.push_back("--partition=" + partition);
  const auto printed = answer(command);
  return printed ? parse_processors(*printed) : std::nullopt;
}

hal::Result<std::vector<QueuedTask>> Cluster::queue(const std::set<std::string>& names) const {
  if (names.empty()) return std::vector<QueuedTask>{};
  const auto printed = answer({"squeue", "--me", "--noheader", "--array",
                               fmt::format("--name={}", fmt::join(names, ",")),
                               "--format=" + std::string(kQueueFormat)});
  if (!printed) return tl::unexpected(printed.error());
  return parse_queue(*printed);
}

hal::Result<std::int64_t> Cluster::submit(const std::vector<std::string>& command) const {
  const auto printed = answer(command);
  if (!printed) return tl::unexpected(printed.error());
  if (const auto job = parse_submission(*printed)) return *job;
  return hal::fail(hal::Errc::kProtocol,
                   fmt::format("sbatch printed '{}', no number of a job", *printed));
}

std::optional<JobEnd> Cluster::end_of(std::int64_t job, int index) const {
  const auto printed =
      answer({"scontrol", "--oneliner", "show", "job", fmt::format("{}_{}", job, index)});
  return printed ? parse_job(*printed) : std::nullopt;
}

hal::Result<void> Cluster::cancel(const std::vector<std::string>& jobs) const {
  if (jobs.empty()) return {};
  std::vector<std::string> command{"scancel"};
  command.insert(command.end(), jobs.begin(), jobs.end());
  const auto printed = answer(command);
  if (!printed) return tl::unexpected(printed.error());
  return {};
}

}  // namespace baraka::slurm
