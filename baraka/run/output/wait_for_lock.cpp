#include "baraka/run/output/wait_for_lock.h"

#include <fmt/format.h>

#include <chrono>
#include <string>
#include <thread>

#include "baraka/run/output/results_folder.h"
#include "baraka/run/pace/interrupts.h"
#include "gateway/process/exit_status.h"

namespace baraka::run::output {
namespace {

constexpr std::chrono::milliseconds kBetweenTries{100};

/// Null: another process holds the lock.
std::unique_ptr<FolderLock> hold_now(const std::filesystem::path& folder, std::string& holder) {
  try {
    return std::make_unique<FolderLock>(folder);
  } catch (const FolderHeld& held) {
    holder = held.what();
    return nullptr;
  }
}

}  // namespace

std::unique_ptr<FolderLock> wait_for_lock(const std::filesystem::path& out) {
  const std::filesystem::path folder = folder_named(out);
  if (folder.has_parent_path()) make_folder(folder.parent_path());
  std::string holder;
  std::unique_ptr<FolderLock> lock = hold_now(folder, holder);
  if (!lock) fmt::print(stderr, "waiting: {}\n", holder);
  while (!lock) {
    if (pace::interrupted())
      throw gateway::process::Interrupted("interrupted while another run was writing there");
    std::this_thread::sleep_for(kBetweenTries);
    lock = hold_now(folder, holder);
  }
  finish_set_aside(folder);
  return lock;
}

}  // namespace baraka::run::output
