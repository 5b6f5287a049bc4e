#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "hal/files/recording/mapped_file.h"

struct sqlite3;
struct sqlite3_stmt;

namespace hal::files::recording {

/// A database that others made, opened for reading. One thread.
class SqliteFile {
 public:
  /// @param name  for messages.
  /// @throws std::runtime_error  as all members and those of SqliteQuery: with the name and
  ///   SQLite's reason.
  SqliteFile(const std::filesystem::path& path, std::string name);
  ~SqliteFile();
  SqliteFile(const SqliteFile&) = delete;
  SqliteFile& operator=(const SqliteFile&) = delete;

  /// Requires an ordinary table: a view or a virtual table could compute anything.
  void require_table(const std::string& table);
  bool has_column(const std::string& table, const std::string& column);
  [[noreturn]] void fail(const std::string& what) const;

 private:
  friend class SqliteQuery;
  std::string name_;
  sqlite3* handle_ = nullptr;
};

/// The rows of a query on one table, whose first column is the rowid.
class SqliteQuery {
 public:
  SqliteQuery(SqliteFile& file, std::string table, const std::string& columns);
  ~SqliteQuery();
  SqliteQuery(const SqliteQuery&) = delete;
  SqliteQuery& operator=(const SqliteQuery&) = delete;

  bool next();
  /// @throws std::runtime_error  the column has no whole number.
  std::int64_t integer(int column) const;
  std::string text(int column) const;
  /// Valid until next().
  Octets blob(int column) const;
  [[noreturn]] void fail(const std::string& what) const;

 private:
  SqliteFile& file_;
  std::string table_;
  sqlite3_stmt* handle_ = nullptr;
  std::int64_t row_ = 0;
};

}  // namespace hal::files::recording
