#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/record/cell_rule.h"

struct sqlite3;
struct sqlite3_stmt;

namespace results::record {

/// What a statement reads: the rules of its result columns, and those of all columns that it uses.
struct ColumnsRead {
  std::vector<const CellRule*> results;  ///< Null: a computed value without a rule.
  std::vector<bool> is_derived;  ///< By result column: it is computed, not a cell of a table.
  std::vector<const CellRule*> columns;
};

/// Protects readers from a database file that somebody else may have written. It requires that the
/// file has the tables as create_tables() makes them, does not run code of the file (views,
/// triggers, expressions), allows statements only to read, and checks that the column of each cell
/// allows its value. Errors are std::runtime_error with file, table, row and column. One thread.
///
/// A cell is checked when it is read, so the cost is proportional to what is read; the row of a bad
/// cell is searched for only when there is one. Cells that are used only in a condition or a sum
/// are not checked one by one, but sums are.
class CellCheck {
 public:
  /// Puts the connection into SQLite's defensive mode.
  /// @param tables  that the file must have; they outlive this object.
  /// @throws std::runtime_error  a table is missing or differs.
  CellCheck(sqlite3* handle, std::string file, const std::vector<Table>& tables);
  ~CellCheck();
  CellCheck(const CellCheck&) = delete;
  CellCheck& operator=(const CellCheck&) = delete;

  /// From now on agents must be among these, and no time may be later than `end` [ns].
  void learn(const std::vector<std::int64_t>& agents, std::int64_t end);

  /// From now on the columns that a statement uses are collected, until take().
  void begin();
  ColumnsRead take(sqlite3_stmt* statement);

  /// @param as  type that the caller reads: checked where the rule leaves the type open, and for
  /// computed values without a rule.
  /// @throws std::runtime_error  the cell of the current row has a value that its column does not
  /// allow.
  void check(sqlite3_stmt* statement, int column, CellRule::Kind as,
             const ColumnsRead& reading) const {
    const CellRule* const rule = reading.results[static_cast<std::size_t>(column)];
    const bool is_told = rule != nullptr && rule->kind != CellRule::Kind::kAny;
    if (is_told && fits(statement, column, *rule)) return;
    look_closer(statement, column, as, reading);
  }

  /// Refuses a value that its reader finds wrong.
  /// @param why  "is before that of the row above"
  /// @throws std::runtime_error  always.
  [[noreturn]] void refuse(sqlite3_stmt* statement, int column, const ColumnsRead& reading,
                           std::string_view why) const;

  /// @throws std::runtime_error  always: SQLite failed in a statement; with its reason.
  [[noreturn]] void fail(const ColumnsRead& reading) const;

 private:
  using Place = std::pair<std::string_view, std::string_view>;  ///< Table and column.

  void make_rules(const std::vector<Table>& tables);
  bool fits(sqlite3_stmt* statement, int column, const CellRule& rule) const;
  bool fits_integer(std::int64_t value, const CellRule& rule) const;
  void look_closer(sqlite3_stmt* statement, int column, CellRule::Kind as,
                   const ColumnsRead& reading) const;
  void refuse_bad_row(const CellRule& rule) const;
  void refuse_bad_rows(const ColumnsRead& reading) const;
  const CellRule* rule_at(std::string_view table, std::string_view column) const;
  const CellRule* rule_of_result(sqlite3_stmt* statement, int column) const;
  static int authorize(void* self, int action, const char* first, const char* second,
                       const char* database, const char* trigger);

  sqlite3* handle_;
  std::string file_;
  std::vector<CellRule> rules_;
  std::map<Place, const CellRule*> by_place_;
  std::map<std::string_view, CellRule*> by_name_;  ///< Names with the same rule in all tables.
  std::vector<CellRule> derived_;                  ///< The rules in by_name_.
  std::vector<bool> agents_;                       ///< By address; empty: agents are not known yet.
  std::vector<const CellRule*> collected_;
};

}  // namespace results::record
