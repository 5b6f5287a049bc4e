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

/// One SQLite file. Every member throws std::runtime_error with the file and SQLite's reason. One
/// thread at a time, including its statements.
class Database {
 public:
  enum class Mode : std::uint8_t { kCreate, kRead, kUpdate };

  /// Called every tenth of a second while other processes lock the file. @param waited_s  time
  /// waited so far [s]. @return whether to go on waiting. It must not throw.
  using WhileBusy = std::function<bool(double waited_s)>;

  /// kCreate replaces the file; kRead requires it; kUpdate keeps its content and creates it if it
  /// does not exist.
  /// @param while_busy  none: waits for up to 5 s for a locked file.
  Database(const std::filesystem::path& file, Mode mode, WhileBusy while_busy = {});
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void execute(const std::string& sql);

  /// For files that others may have written: requires these tables as create_tables() makes them.
  /// From now on statements can only read, and each cell that they return is checked against its
  /// column; errors name file, table, row and column.
  /// @param tables  outlive this object.
  /// @throws std::runtime_error  the file has other tables.
  void read_only_sound(const std::vector<Table>& tables);

  /// From now on cells are checked against this run: agents must be among these, and no time may be
  /// after the end [ns].
  /// @pre read_only_sound()
  void know(const std::vector<std::int64_t>& agents, std::int64_t end);

  /// Rolls back the transaction in progress, if there is one.
  void roll_back();

 private:
  friend class Statement;
  [[noreturn]] void fail(std::string_view doing) const;
  void open(int how);
  void set_waiting();

  std::string name_;
  WhileBusy while_busy_;
  sqlite3* handle_ = nullptr;
  std::unique_ptr<CellCheck> check_;  ///< Null: cells are not checked.
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
    copies_ = false;  // the values outlive the run
    bind_all(values...);
    while (next()) {
    }
    copies_ = true;
  }

  template <class... Values>
  void bind_all(const Values&... values) {
    int place = 0;
    (bind(++place, values), ...);
  }

  /// Advances to the next row. @return false after the last one; the statement can then be run
  /// again.
  bool next();

  /// Value of a column of the current row, counted from 0. Null reads as 0 or "".
  /// @throws std::runtime_error  after read_only_sound(): the column does not allow the value.
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;
  bool is_null(int column) const;
  bool is_real(int column) const;

  /// Refuses a value that its reader cannot accept, because it is out of order or a duplicate.
  /// @param why  "before that of an earlier row"
  /// @throws std::runtime_error  with file, table and, if the statement selects rowid, the row.
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
  bool copies_ = true;                    ///< Whether texts are copied when they are bound.
  std::unique_ptr<ColumnsRead> reading_;  ///< Null: cells are not checked.
};

}  // namespace results::record
