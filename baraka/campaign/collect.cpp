#include "baraka/campaign/collect.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <fstream>
#include <string_view>
#include <utility>

#include "baraka/run/output/folder_lock.h"
#include "gateway/process/exit_status.h"
#include "results/record/run_reader.h"
#include "results/record/scalars.h"

namespace baraka::campaign {
namespace {

namespace fs = std::filesystem;

using results::campaign::Measured;
using results::campaign::RunRow;
using results::campaign::RunState;
using results::record::RunReader;

/// Disk space that a run needs to begin: its reserve (results.cpp) and its tables.
constexpr off_t kLeastRoom = off_t{2} << 20;

/// The unit as written in the database, where "" means none.
std::string unit_of(const std::string& unit) { return unit == "1" ? "" : unit; }

Measured measured_by(RunReader& reader) {
  Measured all;
  for (const results::record::Scalar& one : results::record::scalars_of(reader)) {
    all.measurements.push_back({{one.name, unit_of(one.unit), one.agent}, one.value});
  }
  for (results::record::Series& one : results::record::series_of(reader)) {
    all.series.push_back({{one.name, unit_of(one.unit), one.agent}, std::move(one.points)});
  }
  for (const results::record::Bins& one : results::record::bins_of(reader)) {
    auto& histogram = all.histograms.emplace_back();
    histogram.observable = {one.name, unit_of(one.unit), one.agent};
    for (const auto& bin : one.bins) {
      histogram.bins.push_back({bin.lower, bin.upper, static_cast<std::int64_t>(bin.count)});
    }
  }
  return all;
}

CollectedRun read_finished(RunReader& reader, const results::campaign::RunPlan& run, int status) {
  CollectedRun collected;
  RunRow& row = collected.row;
  row.plan = run;
  row.state = RunState::kDone;
  row.result = reader.value("result");
  if (row.result != "until") row.expectations_met = status == gateway::process::kDone;
  row.fingerprint = reader.value("fingerprint");
  row.simulated_s = reader.real("simulated_s");
  row.wall_s = reader.real("wall_s");
  row.ended = utc_now();
  collected.measured = measured_by(reader);
  return collected;
}

/// The error that a run recorded; "": it recorded none.
std::string own_error(const fs::path& folder) {
  for (const fs::path& place : {folder, fs::path(folder.string() + ".not-started")}) {
    try {
      if (!fs::exists(place / results::record::kResultsFile)) continue;
      RunReader reader(place);
      if (std::string error = reader.value("error"); !error.empty()) return error;
    } catch (const std::exception&) {
      continue;  // cut short before its tables were complete
    }
  }
  return "";
}

/// The error in a run's log, or else the last line of the log.
std::string last_words_of(const fs::path& log) {
  constexpr std::string_view kError = "error: ";
  std::ifstream file(log);
  std::string last;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(kError)) return line.substr(kError.size());
    if (!line.empty()) last = line;
  }
  return last;
}

/// Tests whether the file system has room for so many bytes. @return 0: it has; otherwise errno.
int try_to_write(const fs::path& file, off_t bytes) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) return errno;
  const int error = ::posix_fallocate(descriptor, 0, bytes);
  ::close(descriptor);
  ::unlink(file.c_str());
  return error;
}

bool means_full(int error) { return error == ENOSPC || error == EDQUOT || error == EFBIG; }

}  // namespace

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", utc);
}

std::optional<CollectedRun> collect_finished(const CampaignFolder& folder,
                                             const results::campaign::RunPlan& run) {
  const fs::path result = folder.result_of(run);
  // A database that is being written, maybe by another computer, cannot be read.
  if (run::output::is_held(result) || !fs::exists(result / results::record::kResultsFile))
    return std::nullopt;
  try {
    RunReader reader(result);
    const std::optional<std::int64_t> status = reader.integer("exit_status");
    if (!status || reader.value("seed") != std::to_string(run.seed)) return std::nullopt;
    if (*status != gateway::process::kDone && *status != gateway::process::kExpectationNotMet)
      return std::nullopt;
    return read_finished(reader, run, static_cast<int>(*status));
  } catch (const std::exception&) {
    return std::nullopt;  // cut short before its tables were complete
  }
}

CollectedRun collect(const CampaignFolder& folder, const results::campaign::RunPlan& run,
                     const TaskEnd& end) {
  CollectedRun collected;
  if (auto finished = collect_finished(folder, run)) {
    collected = std::move(*finished);
  } else {
    const std::string words = last_words_of(folder.log_of(run));
    const std::string own = own_error(folder.result_of(run));
    fail(collected, own.empty() ? end.cause + (words.empty() ? "" : ": " + words) : own);
    collected.row.plan = run;
    collected.row.ended = utc_now();
  }
  collected.row.host = end.host;
  if (end.wall_s) collected.row.wall_s = end.wall_s;
  collected.row.user_s = end.user_s;
  return collected;
}

void fail(CollectedRun& collected, const std::string& error) {
  RunRow& row = collected.row;
  row.state = RunState::kFailed;
  row.result = "failed";
  row.expectations_met.reset();
  row.error = error;
  collected.measured = {};
}

void require_room(const CampaignFolder& folder, const std::string& error) {
  // The messages of the C library and of SQLite (sqlite3_errstr(SQLITE_FULL)).
  for (const std::string& words :
       {std::string(std::strerror(ENOSPC)), std::string(std::strerror(EDQUOT)),
        std::string(std::strerror(EFBIG)), std::string("database or disk is full")}) {
    if (error.find(words) != std::string::npos) {
      throw DiskFull(fmt::format("{}: {}", folder.path().string(), error));
    }
  }
  const int refused = try_to_write(folder.path() / ".room", kLeastRoom);
  if (!means_full(refused)) return;
  throw DiskFull(fmt::format("{}: {}", folder.path().string(), std::strerror(refused)));
}

}  // namespace baraka::campaign
