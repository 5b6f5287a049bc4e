#include "sim/record/run_reader.h"

#include <fmt/format.h>

namespace sim::record {

RunReader::RunReader(const std::filesystem::path& folder)
    : folder_(folder), database_(folder / kResultsFile, Database::Mode::kRead) {
  require_version(database_, folder_);
}

std::string RunReader::value(std::string_view key) {
  Statement found = query("SELECT value FROM run WHERE key = ?");
  found.bind_all(key);
  return found.next() ? found.text(0) : std::string();
}

std::map<std::string, std::int64_t> RunReader::count_rows() {
  std::map<std::string, std::int64_t> counts;
  for (const Table& table : tables()) {
    Statement count = query(fmt::format("SELECT COUNT(*) FROM {}", table.name));
    count.next();
    counts[std::string(table.name)] = count.integer(0);
  }
  return counts;
}

}  // namespace sim::record
