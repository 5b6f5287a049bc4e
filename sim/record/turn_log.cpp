#include "sim/record/turn_log.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <system_error>

#include "sim/record/run_reader.h"

namespace sim::record {

namespace {

/// In ns. A run ends before this, about 32 years.
constexpr std::int64_t kLatest = 1'000'000'000'000'000'000;

hal::Time time_in(const std::string& text, const std::filesystem::path& folder) {
  std::int64_t ns = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, ns);
  if (error == std::errc{} && rest == end && ns >= 0 && ns <= kLatest) return hal::time_from_ns(ns);
  throw std::runtime_error(fmt::format("{}: its end at '{}' ns is no time of a run from 0 to {} ns",
                                       folder.string(), text, kLatest));
}

/// Turns are in order of time and end with the run: the queue of events relies on it.
void check_turn(std::int64_t ns, const RecordedTurns& recorded,
                const std::filesystem::path& folder) {
  const std::int64_t first = recorded.turns.empty() ? 0 : hal::to_ns(recorded.turns.back().at);
  const std::int64_t last = hal::to_ns(recorded.ended_at);
  if (ns >= first && ns <= last) return;
  throw std::runtime_error(fmt::format(
      "{}: turn {} of the record is at {} ns; after the one before it and until the end "
      "of the run it may be at {} to {} ns",
      folder.string(), recorded.turns.size() + 1, ns, first, last));
}

}  // namespace

RecordedTurns read_turns(const std::filesystem::path& folder) {
  RunReader run(folder);
  if (!run.value("pace").starts_with("realtime")) {
    throw std::runtime_error(fmt::format("{}: not a run in real time", folder.string()));
  }
  if (run.value("ended_ns").empty()) {
    throw std::runtime_error(fmt::format("{}: this run did not end", folder.string()));
  }
  RecordedTurns recorded;
  recorded.ended_at = time_in(run.value("ended_ns"), folder);
  Statement query = run.query("SELECT at_ns, process, replied, began FROM turns ORDER BY rowid");
  while (query.next()) {
    check_turn(query.integer(0), recorded, folder);
    recorded.turns.push_back({hal::Time{hal::Duration{query.integer(0)}},
                              static_cast<std::size_t>(query.integer(1)), query.integer(2) != 0,
                              query.integer(3) != 0});
  }
  return recorded;
}

}  // namespace sim::record
