#include "results/record/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace results::record {
namespace {

std::string unit_of(const Column& column) {
  return column.unit.empty() ? "" : fmt::format(" [{}]", column.unit);
}

std::string to_sql(const Table& table) {
  if (!table.query.empty()) {
    return fmt::format("CREATE VIEW {} AS  -- {}\n{};\n\n", table.name, table.meaning, table.query);
  }
  std::string sql = fmt::format("CREATE TABLE {} (  -- {}\n", table.name, table.meaning);
  for (const Column& column : table.columns) {
    const bool last = &column == &table.columns.back() && table.primary_key.empty();
    sql += fmt::format("  {}{}{}{}  -- {}{}\n", column.name, column.type.empty() ? "" : " ",
                       column.type, last ? "" : ",", column.meaning, unit_of(column));
  }
  if (!table.primary_key.empty()) sql += fmt::format("  PRIMARY KEY ({})\n", table.primary_key);
  return sql + (table.primary_key.empty() ? ");\n\n" : ") WITHOUT ROWID;\n\n");
}

}  // namespace

std::string_view conventions() {
  return "Times are simulated and count from the start of the run. Lengths and angles are in the "
         "world frame: x and y in the plane, headings from the x axis towards the y axis. Agents "
         "are addresses; 65535 is everyone, 65534 the neighbours of the sender. Verdicts are: "
         "delivered, below sensitivity, preamble missed, collision, interference, noise, obstacle, "
         "retry limit, queue full, receiver transmitting, radio off, no route, expired, agent "
         "down, random loss, queue delay. Fates are: handed over, no route, queue full, failed.";
}

std::string schema_sql(const std::vector<Table>& tables) {
  std::string sql;
  for (const Table& table : tables) sql += to_sql(table);
  return sql;
}

std::string schema_sql() { return schema_sql(tables()); }

const Table* find_table(const std::vector<Table>& tables, std::string_view name) {
  const auto found = std::find_if(tables.begin(), tables.end(),
                                  [&](const Table& table) { return table.name == name; });
  return found == tables.end() ? nullptr : &*found;
}

const Table* find_table(std::string_view name) { return find_table(tables(), name); }

std::string table_names(const std::vector<Table>& tables) {
  std::string names;
  for (const Table& table : tables) {
    names += (names.empty() ? "" : ", ") + std::string(table.name);
  }
  return names;
}

std::string table_names() { return table_names(tables()); }

void create_tables(Database& database) {
  database.execute("PRAGMA synchronous = OFF; BEGIN");
  database.execute(schema_sql());
  database.execute(fmt::format("PRAGMA user_version = {}; COMMIT", kSchemaVersion));
}

void require_version(Database& database, const std::filesystem::path& folder) {
  Statement query(database, "PRAGMA user_version");
  query.next();
  if (query.integer(0) == kSchemaVersion) return;
  throw std::runtime_error(
      fmt::format("{}: {} has tables of version {}, and this baraka reads version {} only: read it "
                  "with the baraka that wrote it, or run it again",
                  folder.string(), kResultsFile, query.integer(0), kSchemaVersion));
}

}  // namespace results::record
