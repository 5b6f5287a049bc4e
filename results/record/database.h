#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace results::record {

class CellCheck;
struct ColumnsRead;
struct Table;

/// One SQLite file. Everything throws std::runtime_error with the file and SQLite's reason. One
/// thread at a time, its statements included.
class Database {
 public:
  enum class Mode : std::uint8_t { kCreate, kRead, kUpdate };

  /// Asked every tenth of a second while other processes have the file, with how long that has been
  /// [s]: whether to wait on. It must not throw.
  using WhileBusy = std::function<bool(double waited_s)>;

  /// kCreate replaces the file; kRead needs it; kUpdate keeps what is in it and makes it if it is
  /// not there.
  /// @param while_busy  none: it is waited for 5 s.
  Database(const std::filesystem::path& file, Mode mode, WhileBusy while_busy = {});
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void execute(const std::string& sql);

  /// For files that others may have written: it must have these tables as create_tables() makes
  /// them, and from now on every cell that a statement gives is one that its column may hold; what
  /// is not is refused with file, table, row and column. Statements can only read.
  /// @param tables  outlive this object.
  /// @throws std::runtime_error  the file has other tables.
  void read_only_sound(const std::vector<Table>& tables);

  /// What its cells are measured by from now on: agents are these, no time [ns] is after the end.
  /// @pre read_only_sound()
  void know(const std::vector<std::int64_t>& agents, std::int64_t end);

  /// Ends a transaction under way and takes its changes back; nothing if there is none.
  void roll_back();

 private:
  friend class Statement;
  [[noreturn]] void fail(std::string_view doing) const;
  void open(int how);
  void set_waiting();

  std::string name_;
  WhileBusy while_busy_;
  sqlite3* handle_ = nullptr;
  std::unique_ptr<CellCheck> check_;  ///< Null: whatever is there is taken.
};

/// One prepared statement.
///
///   Statement insert(db, "INSERT INTO links VALUES (?, ?)");
///   insert.run(1, 2);
///   Statement query(db, "SELECT a, b FROM links");
///   while (query.next()) use(query.integer(0), query.integer(1));
class Statement {
 public:
  Statement(Database& database, std::string_view sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  /// Binds the values to the question marks and runs the statement to its end.
  template <class... Values>
  void run(const Values&... values) {
    bind_all(values...);
    while (next()) {
    }
  }

  template <class... Values>
  void bind_all(const Values&... values) {
    int place = 0;
    (bind(++place, values), ...);
  }

  /// To the next row; false after the last one, and then it can be used again.
  bool next();

  /// Columns of the current row, from 0. Null reads as 0 or "".
  /// @throws std::runtime_error  of a sound database: a value that may not be there
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;
  bool is_null(int column) const;
  bool is_real(int column) const;

  /// Of a value that its reader cannot take: that is out of order, or there twice.
  /// @param why  "before that of an earlier row"
  /// @throws std::runtime_error  with file, table and, if the statement gives its rowid, the row
  [[noreturn]] void refuse(int column, std::string_view why) const;

 private:
  void bind(int place, std::int64_t value);
  void bind(int place, std::uint64_t value) { bind(place, static_cast<std::int64_t>(value)); }
  void bind(int place, int value) { bind(place, std::int64_t{value}); }
  void bind(int place, bool value) { bind(place, std::int64_t{value}); }
  void bind(int place, double value);
  void bind(int place, std::string_view value);
  void bind(int place, const std::string& value) { bind(place, std::string_view(value)); }
  void bind(int place, const char* value) { bind(place, std::string_view(value)); }
  void bind(int place, std::nullopt_t);
  template <class T>
  void bind(int place, const std::optional<T>& value) {
    value ? bind(place, *value) : bind(place, std::nullopt);
  }

  Database& database_;
  sqlite3_stmt* handle_ = nullptr;
  std::unique_ptr<ColumnsRead> reading_;  ///< Null: nothing is checked.
};

}  // namespace results::record
