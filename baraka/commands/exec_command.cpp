#include "baraka/commands/exec_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "gateway/process/exit_status.h"
#include "programs/netns/descriptor.h"
#include "programs/netns/holder.h"
#include "programs/netns/launch.h"
#include "programs/netns/run_state.h"

namespace baraka::commands {
namespace {

std::filesystem::path only_run() {
  const auto runs = programs::netns::running_runs();
  if (runs.size() == 1) return runs[0];
  if (runs.empty()) {
    throw gateway::process::UsageError(
        "no run with agents that have a network is under way; start one first");
  }
  std::string list;
  for (const auto& run : runs) list += fmt::format("\n  --run {}", run.string());
  throw gateway::process::UsageError(
      fmt::format("{} runs are under way; say which:{}", runs.size(), list));
}

}  // namespace

void exec_inside(const ExecOptions& options) {
  const std::filesystem::path folder =
      options.run.empty() ? only_run() : std::filesystem::path(options.run);
  const std::string holder = programs::netns::installed_file({}, "baraka-holder").string();
  std::vector<std::string> words{holder, "enter", folder.string(), options.agent};
  words.insert(words.end(), options.command.begin(), options.command.end());
  execv(holder.c_str(), programs::netns::pointers_to(words).data());
  programs::netns::fail(holder);
}

}  // namespace baraka::commands
