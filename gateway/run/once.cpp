#include "gateway/run/once.h"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <fstream>
#include <iterator>
#include <thread>

#include "gateway/exit_status.h"
#include "gateway/run/results_folder.h"
#include "gateway/run/wall_pace.h"
#include "sim/campaign/extension.h"
#include "sim/record/course_log.h"
#include "sim/record/run_reader.h"
#include "sim/report/plot_request.h"

namespace gateway {
namespace {

constexpr std::chrono::milliseconds kBetweenTries{100};

/// Null: another process has it.
std::unique_ptr<FolderLock> hold_now(const std::filesystem::path& folder, std::string& holder) {
  try {
    return std::make_unique<FolderLock>(folder);
  } catch (const FolderHeld& held) {
    holder = held.what();
    return nullptr;
  }
}

}  // namespace

std::optional<FinishedResult> finished_result(const std::filesystem::path& folder,
                                              std::optional<std::uint64_t> seed) {
  if (!std::filesystem::exists(folder / sim::record::kResultsFile)) return std::nullopt;
  try {
    sim::record::RunReader reader(folder);
    if (seed && reader.value("seed") != std::to_string(*seed)) return std::nullopt;
    const std::optional<std::int64_t> status = reader.integer("exit_status");
    if (status != kDone && status != kExpectationNotMet) return std::nullopt;
    return FinishedResult{static_cast<int>(*status), reader.value("result"),
                          reader.value("fingerprint")};
  } catch (const std::exception&) {
    return std::nullopt;  // cut short before its tables were complete
  }
}

void require_result_of(const std::filesystem::path& folder, const std::string& resolved,
                       const std::string& until) {
  std::ifstream in(folder / "scenario.resolved.yaml");
  const std::string there{std::istreambuf_iterator<char>(in), {}};
  const std::string before = sim::report::without_report_only(there);
  const std::string now = sim::report::without_report_only(resolved);
  const std::string until_there = sim::record::read_settings(folder)["--until"];
  if (before == now && until_there == until) return;
  throw UsageError(fmt::format(
      "{}: holds the result of another run: {}; give another --out, or remove the folder",
      folder.string(),
      before != now ? sim::campaign::first_difference(before, now)
                    : fmt::format("--until: there '{}', now '{}'", until_there, until)));
}

std::unique_ptr<FolderLock> hold_when_free(const std::filesystem::path& out) {
  const std::filesystem::path folder = folder_named(out);
  if (folder.has_parent_path()) make_folder(folder.parent_path());
  std::string holder;
  std::unique_ptr<FolderLock> lock = hold_now(folder, holder);
  if (!lock) fmt::print(stderr, "waiting: {}\n", holder);
  while (!lock) {
    if (interrupted()) throw Interrupted("interrupted while another run was writing there");
    std::this_thread::sleep_for(kBetweenTries);
    lock = hold_now(folder, holder);
  }
  finish_set_aside(folder);
  return lock;
}

}  // namespace gateway
