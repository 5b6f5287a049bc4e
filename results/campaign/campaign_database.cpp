#include "results/campaign/campaign_database.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "results/campaign/schema.h"

namespace results::campaign {
namespace {

using record::Database;
using record::Statement;

std::int64_t version_of(Database& database) {
  Statement query(database, "PRAGMA user_version");
  query.next();
  return query.integer(0);
}

/// Creates the tables of a file that has none, also after an interrupted creation.
void make_tables(Database& database, const std::filesystem::path& folder) {
  // One transaction creates everything, so another process sees all tables or none (version 0).
  const std::int64_t version = version_of(database);
  if (version == kSchemaVersion) return;
  if (version != 0) {
    throw std::runtime_error(fmt::format(
        "{}: {} has tables of version {}, and this baraka writes version {} only: go on with the "
        "baraka that began it, or give another --out",
        folder.string(), kCampaignDatabase, version, kSchemaVersion));
  }
  database.execute("BEGIN IMMEDIATE");
  database.execute(schema_sql());
  database.execute(fmt::format("PRAGMA user_version = {}; COMMIT", kSchemaVersion));
}

std::optional<std::string_view> unless_empty(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional<std::string_view>(text);
}

/// SQLite has no NaN and would store null; it stores infinities as they are.
std::optional<double> defined(std::optional<double> value) {
  return value && std::isnan(*value) ? std::nullopt : value;
}

}  // namespace

CampaignDatabase::CampaignDatabase(const std::filesystem::path& folder,
                                   Database::WhileBusy while_busy)
    : database_(folder / kCampaignDatabase, Database::Mode::kUpdate, std::move(while_busy)) {
  // A rollback journal beside the file works on every file system that can lock files. A
  // transaction is on the disk when it ends.
  database_.execute("PRAGMA journal_mode = DELETE; PRAGMA synchronous = FULL");
  make_tables(database_, folder);
  Statement query(database_, "SELECT observable, name, agent FROM observables");
  while (query.next()) observables_[{query.text(1), query.text(2)}] = query.integer(0);
}

void CampaignDatabase::transact(const std::function<void()>& changes) {
  database_.execute("BEGIN IMMEDIATE");
  try {
    changes();
    database_.execute("COMMIT");
  } catch (...) {
    database_.roll_back();
    observables_.clear();  // the rollback removed new observables, too
    Statement query(database_, "SELECT observable, name, agent FROM observables");
    while (query.next()) observables_[{query.text(1), query.text(2)}] = query.integer(0);
    throw;
  }
}

bool CampaignDatabase::is_empty() {
  Statement query(database_, "SELECT COUNT(*) FROM campaign");
  query.next();
  return query.integer(0) == 0;
}

std::string CampaignDatabase::value(std::string_view key) {
  Statement found(database_, "SELECT value FROM campaign WHERE key = ?");
  found.bind_all(key);
  return found.next() ? found.text(0) : std::string();
}

void CampaignDatabase::set(std::string_view key, std::string_view value) {
  transact([&] {
    Statement(database_, "INSERT OR REPLACE INTO campaign VALUES (?, ?)").run(key, value);
  });
}

void CampaignDatabase::add(const Plan& plan) {
  transact([&] {
    Statement values(database_, "INSERT OR REPLACE INTO campaign VALUES (?, ?)");
    for (const auto& [key, value] : plan.values) values.run(key, value);
    Statement factors(database_, "INSERT INTO factors VALUES (NULL, ?, ?)");
    for (const Factor& factor : plan.factors) factors.run(factor.key, factor.unit);
    Statement points(database_, "INSERT INTO points VALUES (?, ?, ?)");
    Statement levels(database_, "INSERT INTO levels VALUES (?, ?, ?, ?, ?)");
    for (const PointRow& point : plan.points) {
      points.run(point.point, point.label, point.scenario);
      int factor = 0;
      for (const Level& level : point.levels) {
        levels.run(point.point, ++factor, level.text, level.number, level.is_default);
      }
    }
    Statement rewrite(database_, "UPDATE points SET scenario = ?2 WHERE point = ?1");
    for (const PointRow& point : plan.rewritten) rewrite.run(point.point, point.scenario);
    Statement runs(database_,
                   "INSERT INTO runs (run, point, replication, seed, state, attempts) VALUES "
                   "(?, ?, ?, ?, 'waiting', 0)");
    for (const RunPlan& run : plan.runs) runs.run(run.run, run.point, run.replication, run.seed);
  });
}

void CampaignDatabase::start(std::span<const std::int64_t> runs, const std::string& started) {
  transact([&] {
    Statement update(database_,
                     "UPDATE runs SET state = 'running', attempts = attempts + 1, started = ?2 "
                     "WHERE run = ?1");
    for (const std::int64_t run : runs) update.run(run, started);
  });
}

void CampaignDatabase::forget(std::int64_t run) {
  // All three tables are indexed by observable and run, so rows of other runs are not read.
  constexpr const char* kOfRun =
      "DELETE FROM {} WHERE observable IN (SELECT observable FROM observables) AND run = ?";
  for (const char* table : {"measurements", "series", "bins"}) {
    Statement(database_, fmt::format(kOfRun, table)).run(run);
  }
}

void CampaignDatabase::reset(std::span<const std::int64_t> runs) {
  transact([&] {
    Statement update(
        database_,
        "UPDATE runs SET state = 'waiting', result = NULL, expectations_met = NULL, error = NULL, "
        "fingerprint = NULL, simulated_s = NULL, wall_s = NULL, user_s = NULL, host = NULL, "
        "ended = NULL, folder = NULL WHERE run = ?");
    for (const std::int64_t run : runs) {
      update.run(run);
      forget(run);
    }
  });
}

std::int64_t CampaignDatabase::number_of(const MeasuredBy& observable) {
  const auto [found, is_new] = observables_.try_emplace({observable.name, observable.agent});
  if (is_new) {
    Statement(database_, "INSERT INTO observables VALUES (NULL, ?, ?, ?)")
        .run(observable.name, observable.unit, observable.agent);
    Statement query(database_, "SELECT last_insert_rowid()");
    query.next();
    found->second = query.integer(0);
  }
  return found->second;
}

void CampaignDatabase::add_measured(std::int64_t run, const Measured& measured) {
  Statement measurements(database_, "INSERT INTO measurements VALUES (?, ?, ?)");
  for (const Measurement& one : measured.measurements) {
    measurements.run(run, number_of(one.observable), defined(one.value));
  }
  Statement series(database_, "INSERT INTO series VALUES (?, ?, ?, ?)");
  for (const MeasuredSeries& one : measured.series) {
    const std::int64_t observable = number_of(one.observable);
    for (const auto& [at, value] : one.points) series.run(run, observable, at, defined(value));
  }
  Statement bins(database_, "INSERT INTO bins VALUES (?, ?, ?, ?, ?)");
  for (const MeasuredHistogram& one : measured.histograms) {
    const std::int64_t observable = number_of(one.observable);
    for (const MeasuredBin& bin : one.bins)
      bins.run(run, observable, bin.lower, bin.upper, bin.count);
  }
}

void CampaignDatabase::finish(const RunRow& row, const Measured& measured) {
  transact([&] {
    forget(row.plan.run);
    Statement(database_,
              "UPDATE runs SET state = ?2, result = ?3, expectations_met = ?4, error = ?5, "
              "fingerprint = ?6, simulated_s = ?7, wall_s = ?8, user_s = ?9, host = ?10, "
              "ended = ?11, folder = ?12 WHERE run = ?1")
        .run(row.plan.run, name_of(row.state), unless_empty(row.result), row.expectations_met,
             unless_empty(row.error), unless_empty(row.fingerprint), row.simulated_s, row.wall_s,
             row.user_s, unless_empty(row.host), unless_empty(row.ended), unless_empty(row.folder));
    add_measured(row.plan.run, measured);
  });
}

}  // namespace results::campaign
