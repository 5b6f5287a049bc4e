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

/// What a statement reads: the rules of its result columns and of all columns that it looks at.
struct ColumnsRead {
  std::vector<const CellRule*> results;  ///< Null: computed, and nothing is known of it.
  std::vector<bool> is_derived;          ///< Of each: not a cell of a table as it stands.
  std::vector<const CellRule*> columns;
};

/// What stands between a file of tables and whoever reads it: the file has these tables as they are
/// written and its own code in it (views, triggers, expressions) is not run, statements only read,
/// and every cell that they give is one that its column may hold. What is refused is named with
/// file, table, row and column: std::runtime_error. One thread.
///
/// A cell is looked at when it is read, so that reading costs in proportion to what is read. The
/// row of a bad one is searched for only then. Cells that only a condition or a sum sees are not
/// looked at one by one, sums are as a whole.
class CellCheck {
 public:
  /// Sets the file up for careful reading.
  /// @param tables  that it must have; they outlive this object.
  /// @throws std::runtime_error  it has others by these names.
  CellCheck(sqlite3* handle, std::string file, const std::vector<Table>& tables);
  ~CellCheck();
  CellCheck(const CellCheck&) = delete;
  CellCheck& operator=(const CellCheck&) = delete;

  /// From now on agents are these, and no time is after this [ns].
  void learn(const std::vector<std::int64_t>& agents, std::int64_t end);

  /// From now on columns are collected, until take().
  void begin();
  ColumnsRead take(sqlite3_stmt* statement);

  /// @param as  how it is read: a computed value and one of any type must be of it.
  /// @throws std::runtime_error  the cell of the current row may not be.
  void check(sqlite3_stmt* statement, int column, CellRule::Kind as,
             const ColumnsRead& reading) const {
    const CellRule* const rule = reading.results[static_cast<std::size_t>(column)];
    const bool is_told = rule != nullptr && rule->kind != CellRule::Kind::kAny;
    if (is_told && fits(statement, column, *rule)) return;
    look_closer(statement, column, as, reading);
  }

  /// @throws std::runtime_error  the value of the current row is wrong in the eyes of its reader.
  /// @param why  "is before that of the row above"
  [[noreturn]] void refuse(sqlite3_stmt* statement, int column, const ColumnsRead& reading,
                           std::string_view why) const;

  /// @throws std::runtime_error  SQLite cannot go on with a statement; with its reason.
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
  std::map<std::string_view, CellRule*> by_name_;  ///< Of names that mean the same everywhere.
  std::vector<CellRule> derived_;                  ///< Of by_name_.
  std::vector<bool> agents_;                       ///< By address; empty: not known yet.
  std::vector<const CellRule*> collected_;
};

}  // namespace results::record
