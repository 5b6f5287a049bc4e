#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "results/record/database.h"

namespace results::record {

/// Version of the tables below, stored as `PRAGMA user_version` of the file. It is incremented by
/// any change of a table, of a column or of a meaning; readers accept this version only.
inline constexpr int kSchemaVersion = 18;

/// Name of the file with the tables, in the folder of a result.
inline constexpr const char* kResultsFile = "run.sqlite";

/// One column of a table.
struct Column {
  std::string_view name;  ///< Ends in the unit if there is one: `x_m`, `yaw_rad`, `at_ns`.
  std::string_view type;  ///< SQLite type, with NOT NULL if it is never null.
  std::string_view unit;  ///< "m", "rad", "ns", "s", "dBm", "bit", "byte", "MHz"; "" for none.
  std::string_view meaning;
};

/// One table of `run.sqlite`.
struct Table {
  std::string_view name;
  std::string_view meaning;
  std::vector<Column> columns;
  std::string_view primary_key = "";  ///< Columns, separated by ", "; "" for none.
  std::string_view query = "";        ///< If not "": a view, with this SELECT.
};

/// A key of the table `run`; its name ends in the unit, like that of a column.
struct RunKey {
  std::string_view name, unit, meaning;
};

/// The tables of `run.sqlite`, and the keys of its table `run`. The file, its description and the
/// list of what can be exported are all made from these.
const std::vector<Table>& tables();
const std::vector<RunKey>& run_keys();

/// Whether the value of a key of the table `run` is a whole number >= 0.
bool is_count(const RunKey& key);

/// @return null if there is no table of that name.
const Table* find_table(std::string_view name);

/// "run, settings, agents, …"
std::string table_names();

/// Conventions for all tables, in one paragraph.
std::string_view conventions();

/// SQL that creates the tables. Meanings are comments: SQLite keeps them, and `sqlite3 run.sqlite
/// .schema` shows them.
std::string schema_sql();

/// The same for other tables than those of `run.sqlite`, for files of other kinds.
std::string schema_sql(const std::vector<Table>& tables);
const Table* find_table(const std::vector<Table>& tables, std::string_view name);
std::string table_names(const std::vector<Table>& tables);

/// Creates the tables in a new file. Neither this nor later writes wait for the disk: the last
/// seconds are lost if the machine crashes, but not if the process does.
void create_tables(Database& database);

/// @param folder  of the result, for the message.
/// @throws std::runtime_error  the file has tables of another version; the message has both
/// versions.
void require_version(Database& database, const std::filesystem::path& folder);

}  // namespace results::record
