#include "results/record/replay_log.h"

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "results/record/hexadecimal.h"
#include "results/record/run_reader.h"

namespace results::record {

namespace {

/// The time in the first column of a row. Turns and arrivals must be in order of time, because the
/// event queue relies on it.
hal::Time time_of(const Statement& row, hal::Time after) {
  const hal::Time at{hal::Duration{row.integer(0)}};
  if (at < after) row.refuse(0, fmt::format("before {} ns of the row above", hal::to_ns(after)));
  return at;
}

void read_turns(RunReader& run, ReplayLog& log) {
  Statement query =
      run.query("SELECT at_ns, process, replied, began, rowid FROM turns ORDER BY rowid");
  hal::Time last{};
  while (query.next()) {
    last = time_of(query, last);
    log.turns.push_back({last, static_cast<std::size_t>(query.integer(1)), query.integer(2) != 0,
                         query.integer(3) != 0});
  }
}

void read_arrivals(RunReader& run, ReplayLog& log) {
  Statement query = run.query("SELECT at_ns, door, bytes, rowid FROM arrivals ORDER BY rowid");
  hal::Time last{};
  while (query.next()) {
    last = time_of(query, last);
    auto bytes = from_hexadecimal(query.text(2));
    if (!bytes) query.refuse(2, "not hexadecimal");
    log.arrivals.push_back({last, query.text(1), std::move(*bytes)});
  }
}

/// @throws std::runtime_error  the run has not recorded its inputs.
void require_inputs(RunReader& run, const std::string& file) {
  Statement setting = run.query("SELECT value FROM settings WHERE key = 'record.inputs'");
  if (!setting.next() || setting.text(0) == "all") return;
  throw std::runtime_error(
      fmt::format("{}: table settings, row record.inputs: what came in from outside was not "
                  "recorded, so the run cannot be repeated",
                  file));
}

}  // namespace

std::map<std::string, std::string> read_settings(const std::filesystem::path& folder) {
  RunReader run(folder);
  std::map<std::string, std::string> settings;
  Statement query = run.query("SELECT key, value FROM settings");
  while (query.next()) settings[query.text(0)] = query.text(1);
  return settings;
}

ReplayLog read_replay_log(const std::filesystem::path& folder) {
  RunReader run(folder);
  const std::string file = (folder / kResultsFile).string();
  const std::string pace = run.value("pace");
  ReplayLog log;
  log.in_real_time = pace.starts_with("realtime");
  if (!log.in_real_time && pace != "lockstep") {
    throw std::runtime_error(
        fmt::format("{}: table run, row pace: not a run in real time, but itself {}", file,
                    pace.empty() ? "without a pace" : pace));
  }
  const std::optional<std::int64_t> ended = run.integer("ended_ns");
  if (!ended) {
    throw std::runtime_error(
        fmt::format("{}: table run, row ended_ns: this run did not end", file));
  }
  log.ended_at = hal::time_from_ns(*ended);
  require_inputs(run, file);
  read_turns(run, log);
  read_arrivals(run, log);
  if (log.in_real_time || !log.arrivals.empty()) return log;
  throw std::runtime_error(fmt::format(
      "{}: not a run in real time, and nothing came into it from outside: its scenario and seed "
      "alone repeat it",
      file));
}

}  // namespace results::record
