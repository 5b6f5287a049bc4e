#include "results/campaign/campaign_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "results/campaign/schema.h"

namespace results::campaign {
namespace {

using record::Statement;

constexpr std::array kStates = {RunState::kWaiting, RunState::kRunning, RunState::kDone,
                                RunState::kFailed};

/// @pre The name is one of the words that the column may hold.
RunState state_called(const std::string& name) {
  const auto* const found =
      std::ranges::find(kStates, name, [](RunState state) { return name_of(state); });
  return found == kStates.end() ? RunState::kFailed : *found;
}

std::optional<double> number_in(const Statement& query, int column) {
  return query.is_null(column) ? std::nullopt : std::optional(query.real(column));
}

RunRow row_of(const Statement& query) {
  RunRow row;
  row.plan = {query.integer(0), static_cast<int>(query.integer(1)),
              static_cast<int>(query.integer(2)), static_cast<std::uint64_t>(query.integer(3))};
  row.state = state_called(query.text(4));
  row.result = query.text(5);
  if (!query.is_null(6)) row.expectations_met = query.integer(6) != 0;
  row.error = query.text(7);
  row.fingerprint = query.text(8);
  row.simulated_s = number_in(query, 9);
  row.wall_s = number_in(query, 10);
  row.user_s = number_in(query, 11);
  row.host = query.text(12);
  row.attempts = static_cast<int>(query.integer(13));
  row.started = query.text(14);
  row.ended = query.text(15);
  row.folder = query.text(16);
  return row;
}

}  // namespace

std::string_view name_of(RunState state) {
  switch (state) {
    case RunState::kWaiting:
      return "waiting";
    case RunState::kRunning:
      return "running";
    case RunState::kDone:
      return "done";
    case RunState::kFailed:
      return "failed";
  }
  return {};
}

CampaignReader::CampaignReader(const std::filesystem::path& folder)
    : folder_(folder), database_(folder / kCampaignDatabase, record::Database::Mode::kRead) {
  Statement version = query("PRAGMA user_version");
  version.next();
  if (version.integer(0) != kSchemaVersion) {
    throw std::runtime_error(fmt::format(
        "{}: {} has tables of version {}, and this baraka reads version {} only: read it "
        "with the baraka that wrote it",
        folder_.string(), kCampaignDatabase, version.integer(0), kSchemaVersion));
  }
  database_.read_only_sound(tables());
}

bool CampaignReader::has_database(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / kCampaignDatabase);
}

bool CampaignReader::is_campaign(const std::filesystem::path& folder) {
  return has_database(folder) && !std::filesystem::exists(folder / kReplicationsFile);
}

std::string CampaignReader::value(std::string_view key) {
  Statement found = query("SELECT value FROM campaign WHERE key = ?");
  found.bind_all(key);
  return found.next() ? found.text(0) : std::string();
}

std::vector<Factor> CampaignReader::factors() {
  std::vector<Factor> all;
  Statement rows = query("SELECT key, unit FROM factors ORDER BY factor");
  while (rows.next()) all.push_back({rows.text(0), rows.text(1)});
  return all;
}

std::vector<PointRow> CampaignReader::points() {
  std::vector<PointRow> all;
  const std::size_t wanted = factors().size();
  Statement rows =
      query("SELECT point, label, scenario, point AS rowid FROM points ORDER BY point");
  Statement levels =
      query("SELECT text, number, is_default FROM levels WHERE point = ? ORDER BY factor");
  while (rows.next()) {
    PointRow& point = all.emplace_back();
    point.point = static_cast<int>(rows.integer(0));
    point.label = rows.text(1);
    point.scenario = rows.text(2);
    levels.bind_all(point.point);
    while (levels.next()) {
      point.levels.push_back({levels.text(0), number_in(levels, 1), levels.integer(2) != 0});
    }
    if (point.levels.size() == wanted) continue;
    rows.refuse(0, fmt::format("with {} levels of {} factors", point.levels.size(), wanted));
  }
  return all;
}

std::vector<RunRow> CampaignReader::runs() {
  std::vector<RunRow> all;
  Statement rows = query(
      "SELECT run, point, replication, seed, state, result, expectations_met, error, fingerprint, "
      "simulated_s, wall_s, user_s, host, attempts, started, ended, folder, run AS rowid,"
      " EXISTS (SELECT 1 FROM points p WHERE p.point = r.point) FROM runs r ORDER BY run");
  while (rows.next()) {
    all.push_back(row_of(rows));
    if (rows.integer(18) == 0) rows.refuse(1, "not in the table points");
  }
  return all;
}

std::map<std::string, std::int64_t> CampaignReader::count_rows() {
  std::map<std::string, std::int64_t> counts;
  for (const record::Table& table : tables()) {
    Statement count = query(fmt::format("SELECT COUNT(*) FROM {}", table.name));
    count.next();
    counts[std::string(table.name)] = count.integer(0);
  }
  return counts;
}

}  // namespace results::campaign
