#include "hal/files/recording/sqlite_query.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <stdexcept>
#include <utility>

#include "hal/types/printable.h"

namespace hal::files::recording {

SqliteFile::SqliteFile(const std::filesystem::path& path, std::string name)
    : name_(std::move(name)) {
  constexpr int kReadOnly = SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX;
  if (sqlite3_open_v2(path.c_str(), &handle_, kReadOnly, nullptr) != SQLITE_OK) {
    const std::string reason = handle_ == nullptr ? "no memory" : sqlite3_errmsg(handle_);
    sqlite3_close(handle_);
    throw std::runtime_error(fmt::format("{}: cannot be opened: {}", name_, reason));
  }
  sqlite3_db_config(handle_, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(handle_, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
}

SqliteFile::~SqliteFile() { sqlite3_close(handle_); }

void SqliteFile::fail(const std::string& what) const {
  throw std::runtime_error(fmt::format("{}: {}", name_, what));
}

void SqliteFile::require_table(const std::string& table) {
  SqliteQuery query(*this, "sqlite_master",
                    "type, sql FROM sqlite_master WHERE name = '" + table + "'");
  if (!query.next()) fail(fmt::format("it has no table {}: it is no file of rosbag2", table));
  if (query.text(1) != "table" || !query.text(2).starts_with("CREATE TABLE"))
    fail(fmt::format("{} is not an ordinary table: {}", table, printable(query.text(2))));
}

bool SqliteFile::has_column(const std::string& table, const std::string& column) {
  return sqlite3_table_column_metadata(handle_, "main", table.c_str(), column.c_str(), nullptr,
                                       nullptr, nullptr, nullptr, nullptr) == SQLITE_OK;
}

SqliteQuery::SqliteQuery(SqliteFile& file, std::string table, const std::string& columns)
    : file_(file), table_(std::move(table)) {
  const std::string sql = "SELECT rowid, " + columns;
  if (sqlite3_prepare_v2(file_.handle_, sql.c_str(), -1, &handle_, nullptr) != SQLITE_OK)
    file_.fail(fmt::format("table {}: {}", table_, printable(sqlite3_errmsg(file_.handle_))));
}

SqliteQuery::~SqliteQuery() { sqlite3_finalize(handle_); }

bool SqliteQuery::next() {
  const int result = sqlite3_step(handle_);
  if (result == SQLITE_DONE) return false;
  if (result != SQLITE_ROW)
    file_.fail(fmt::format("table {}, after row {}: {}", table_, row_,
                           printable(sqlite3_errmsg(file_.handle_))));
  row_ = sqlite3_column_int64(handle_, 0);
  return true;
}

std::int64_t SqliteQuery::integer(int column) const {
  if (sqlite3_column_type(handle_, column) != SQLITE_INTEGER)
    fail(fmt::format("{} is not a whole number", sqlite3_column_name(handle_, column)));
  return sqlite3_column_int64(handle_, column);
}

std::string SqliteQuery::text(int column) const {
  const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column));
  const int size = sqlite3_column_bytes(handle_, column);
  return text == nullptr ? std::string() : std::string(text, static_cast<std::size_t>(size));
}

Octets SqliteQuery::blob(int column) const {
  if (sqlite3_column_type(handle_, column) != SQLITE_BLOB)
    fail(fmt::format("{} is not a blob", sqlite3_column_name(handle_, column)));
  const auto* const data = static_cast<const std::byte*>(sqlite3_column_blob(handle_, column));
  return {data, static_cast<std::size_t>(sqlite3_column_bytes(handle_, column))};
}

void SqliteQuery::fail(const std::string& what) const {
  file_.fail(fmt::format("table {}, row {}: {}", table_, row_, what));
}

}  // namespace hal::files::recording
