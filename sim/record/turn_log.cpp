#include "sim/record/turn_log.h"

#include <fmt/format.h>

#include <stdexcept>

#include "sim/record/database.h"
#include "sim/record/run_result.h"
#include "sim/record/schema.h"

namespace sim::record {

RecordedTurns read_turns(const std::filesystem::path& folder) {
  const RunResult run = read_run(folder);
  if (!run.value("pace").starts_with("realtime")) {
    throw std::runtime_error(fmt::format("{}: not a run in real time", folder.string()));
  }
  if (run.value("ended_ns").empty()) {
    throw std::runtime_error(fmt::format("{}: this run did not end", folder.string()));
  }
  RecordedTurns recorded;
  recorded.ended_at = hal::Time{hal::Duration{std::stoll(run.value("ended_ns"))}};
  Database database(folder / kResultsFile, Database::Mode::kRead);
  Statement query(database, "SELECT at_ns, process, replied, began FROM turns ORDER BY rowid");
  while (query.next()) {
    recorded.turns.push_back({hal::Time{hal::Duration{query.integer(0)}},
                              static_cast<std::size_t>(query.integer(1)), query.integer(2) != 0,
                              query.integer(3) != 0});
  }
  return recorded;
}

}  // namespace sim::record
