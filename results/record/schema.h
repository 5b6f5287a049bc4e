#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "results/record/database.h"

namespace results::record {

/// Version of the tables below, as `PRAGMA user_version` of the file. Any change of a table, of a
/// column or of what one means is a new version; readers accept this one only.
inline constexpr int kSchemaVersion = 14;

/// The file with the tables, in the folder of a result.
inline constexpr const char* kResultsFile = "run.sqlite";

/// One column of a table.
struct Column {
  std::string_view name;  ///< Ends in the unit if it has one: `x_m`, `yaw_rad`, `at_ns`.
  std::string_view type;  ///< Of SQLite, with NOT NULL where it is never null.
  std::string_view unit;  ///< "m", "rad", "ns", "s", "dBm", "bit", "byte"; "" for none.
  std::string_view meaning;
};

/// One table of `run.sqlite`.
struct Table {
  std::string_view name;
  std::string_view meaning;
  std::vector<Column> columns;
  std::string_view primary_key = "";  ///< Columns, separated by ", "; "" for none.
  std::string_view query = "";        ///< Not "": a view that selects the columns with this.
};

/// A key of the table `run`; its name ends in the unit as a column's does.
struct RunKey {
  std::string_view name, unit, meaning;
};

/// The tables of `run.sqlite`, and the keys of its table `run`: the one source of the file, of its
/// description and of what may be exported.
const std::vector<Table>& tables();
const std::vector<RunKey>& run_keys();

/// Whether a key of the table `run` is a whole number that is not negative.
bool is_count(const RunKey& key);

/// @return null: there is none of that name.
const Table* find_table(std::string_view name);

/// "run, settings, agents, …"
std::string table_names();

/// Conventions that hold for all tables, in one paragraph.
std::string_view conventions();

/// As SQL, meanings as comments: SQLite keeps them, `sqlite3 run.sqlite .schema` shows them.
std::string schema_sql();

/// The same of other tables than those of `run.sqlite`: of a file of another kind.
std::string schema_sql(const std::vector<Table>& tables);
const Table* find_table(const std::vector<Table>& tables, std::string_view name);
std::string table_names(const std::vector<Table>& tables);

/// Makes the tables in a new file. It does not wait for the disk, then or later: if the machine
/// dies, the last seconds are lost, but not if the process does.
void create_tables(Database& database);

/// @param folder  of the result, for the message.
/// @throws std::runtime_error  the file has tables of another version; both are named.
void require_version(Database& database, const std::filesystem::path& folder);

}  // namespace results::record
