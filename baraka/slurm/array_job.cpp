#include "baraka/slurm/array_job.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdint>

namespace baraka::slurm {
namespace {

/// Quotes a text as one word of the shell.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char letter : text) word += letter == '\'' ? "'\\''" : std::string(1, letter);
  return word + "'";
}

/// A duration for `sbatch --time`, rounded up to whole seconds: "1-02:03:04".
std::string time_limit(hal::Duration limit) {
  const std::int64_t seconds = std::chrono::ceil<std::chrono::seconds>(limit).count();
  return fmt::format("{}-{:02}:{:02}:{:02}", seconds / 86400, seconds / 3600 % 24,
                     seconds / 60 % 60, seconds % 60);
}

}  // namespace

std::string indices_of(const ArrayJob& job) {
  std::string text;
  for (std::size_t first = 0; first < job.tasks.size();) {
    std::size_t last = first;
    while (last + 1 < job.tasks.size() && job.tasks[last + 1].index == job.tasks[last].index + 1) {
      ++last;
    }
    text += fmt::format("{}{}", text.empty() ? "" : ",", job.tasks[first].index);
    if (last > first) text += fmt::format("-{}", job.tasks[last].index);
    first = last + 1;
  }
  if (job.at_once) text += fmt::format("%{}", *job.at_once);
  return text;
}

std::string script_of(const ArrayJob& job) {
  std::string text = fmt::format(
      "#!/bin/bash\n# Of `baraka campaign`, job {}: each task becomes one run.\n"
      "case \"$SLURM_ARRAY_TASK_ID\" in\n",
      job.name);
  for (const Task& task : job.tasks) {
    text += fmt::format("{}) exec {}", task.index, quoted(job.program.string()));
    for (const std::string& argument : task.arguments) text += " " + quoted(argument);
    text += fmt::format(" >>{} 2>&1 ;;\n", quoted(task.log.string()));
  }
  return text +
         "*) echo \"error: no task $SLURM_ARRAY_TASK_ID in this job\" >&2; exit 2 ;;\nesac\n";
}

std::vector<std::string> submission_of(const ArrayJob& job,
                                       const results::campaign::SlurmSettings& settings,
                                       const std::filesystem::path& script) {
  // sbatch would take a '%' in a path as the beginning of a pattern.
  std::string log = job.log.string();
  for (std::size_t at = 0; (at = log.find('%', at)) != std::string::npos; at += 2) {
    log.insert(at, "%");
  }
  std::vector<std::string> command{"sbatch",
                                   "--parsable",
                                   "--job-name=" + job.name,
                                   "--array=" + indices_of(job),
                                   "--requeue",
                                   "--ntasks=1",
                                   "--chdir=" + job.folder.string(),
                                   "--output=" + log,
                                   "--open-mode=append"};
  if (!settings.partition.empty()) command.push_back("--partition=" + settings.partition);
  if (settings.time) command.push_back("--time=" + time_limit(*settings.time));
  command.insert(command.end(), settings.arguments.begin(), settings.arguments.end());
  command.push_back(script.string());
  return command;
}

}  // namespace baraka::slurm
