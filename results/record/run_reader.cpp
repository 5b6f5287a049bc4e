#include "results/record/run_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "results/record/cell_rule.h"

namespace results::record {
namespace {

/// Checks a key whose value is a number; other keys are accepted. @param row  its column 1 is the
/// value.
void check_number(const RunKey& key, const Statement& row) {
  constexpr auto kLatest = static_cast<double>(kLatestTime);
  const bool is_whole = is_count(key) || key.unit == "ns";
  if (!is_whole && key.unit != "s") return;
  const double value = row.real(1);
  if (is_whole ? row.integer(1) < 0 : value < 0) row.refuse(1, "negative");
  const bool is_too_long =
      (key.unit == "s" && value > kLatest / 1e9) || (key.unit == "ns" && value > kLatest);
  if (is_too_long) row.refuse(1, "longer than a run can be");
}

}  // namespace

RunReader::RunReader(const std::filesystem::path& folder)
    : folder_(folder), database_(folder / kResultsFile, Database::Mode::kRead) {
  require_version(database_, folder_);
  database_.read_only_sound(tables());
  check_keys();
  database_.know(agents(), integer("ended_ns").value_or(kLatestTime));
}

/// Checks the values that are numbers.
void RunReader::check_keys() {
  Statement rows = query("SELECT key AS rowid, value FROM run");
  while (rows.next()) {
    const std::string key = rows.text(0);
    const auto known = std::ranges::find(run_keys(), key, &RunKey::name);
    if (known != run_keys().end() && !rows.is_null(1)) check_number(*known, rows);
  }
}

std::vector<std::int64_t> RunReader::agents() {
  std::vector<std::int64_t> addresses;
  Statement rows = query("SELECT agent AS rowid FROM agents ORDER BY agent");
  while (rows.next()) {
    if (!addresses.empty() && addresses.back() == rows.integer(0)) rows.refuse(0, "there twice");
    addresses.push_back(rows.integer(0));
  }
  return addresses;
}

std::optional<std::int64_t> RunReader::integer(std::string_view key) {
  Statement found = query("SELECT value FROM run WHERE key = ?");
  found.bind_all(key);
  if (!found.next() || found.is_null(0)) return std::nullopt;
  return found.integer(0);
}

std::optional<double> RunReader::real(std::string_view key) {
  Statement found = query("SELECT value FROM run WHERE key = ?");
  found.bind_all(key);
  if (!found.next() || found.is_null(0)) return std::nullopt;
  return found.real(0);
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

}  // namespace results::record
