#include "results/record/row_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>

#include "hal/types/check.h"
#include "results/record/hexadecimal.h"

namespace results::record {
namespace {

int width(const Table& table) { return static_cast<int>(table.columns.size()); }

bool is_of(const Table& table, int column, std::string_view type) {
  return table.columns[static_cast<std::size_t>(column)].type.starts_with(type);
}

/// All columns, then rowid.
std::string select_sql(const Table& table) {
  std::string columns;
  for (const Column& column : table.columns) columns += fmt::format("{}, ", column.name);
  return fmt::format("SELECT {}rowid FROM {}", columns, table.name);
}

std::optional<std::string> cell_of(const Statement& row, const Table& table, int column) {
  if (row.is_null(column)) return std::nullopt;
  if (is_of(table, column, "INTEGER")) return fmt::format("{}", row.integer(column));
  if (is_of(table, column, "REAL")) return fmt::format("{}", row.real(column));
  std::string text = row.text(column);
  const bool is_hexadecimal = table.columns[static_cast<std::size_t>(column)].name == "bytes";
  if (is_hexadecimal && !from_hexadecimal(text)) row.refuse(column, "not hexadecimal");
  return text;
}

Row row_of(const Statement& row, const Table& table) {
  Row read{.table = &table, .cells = {}};
  read.cells.reserve(table.columns.size());
  for (int i = 0; i < width(table); ++i) read.cells.push_back(cell_of(row, table, i));
  return read;
}

/// The rows of a table in one run.
class Rows {
 public:
  Rows(RunReader& run, const Table& table)
      : run_(run), table_(table), rows_(run.query(select_sql(table) + " ORDER BY rowid")) {}

  bool next() {
    if (is_there_) last_ = rows_.integer(width(table_));
    is_there_ = rows_.next();
    return is_there_;
  }

  /// The current row; nullopt after the last one.
  std::optional<Row> row() const {
    if (!is_there_) return std::nullopt;
    return row_of(rows_, table_);
  }

  /// The row before the current one, or the last one of all.
  std::optional<Row> before() {
    if (!last_) return std::nullopt;
    return find_row(run_, table_.name, "rowid", *last_);
  }

  /// Whether the current rows are equal. @pre both are there.
  bool equals(const Rows& other) const {
    for (int i = 0; i < width(table_); ++i) {
      if (rows_.is_null(i) != other.rows_.is_null(i)) return false;
      if (!rows_.is_null(i) && !equals(other, i)) return false;
    }
    return true;
  }

 private:
  bool equals(const Rows& other, int column) const {
    if (is_of(table_, column, "INTEGER"))
      return rows_.integer(column) == other.rows_.integer(column);
    if (is_of(table_, column, "REAL")) return rows_.real(column) == other.rows_.real(column);
    return rows_.text(column) == other.rows_.text(column);
  }

  RunReader& run_;
  const Table& table_;
  Statement rows_;
  bool is_there_ = false;
  std::optional<std::int64_t> last_;  ///< rowid
};

const Table& table_called(std::string_view name) {
  const Table* const table = find_table(name);
  BARAKA_CHECK(table != nullptr);
  return *table;
}

}  // namespace

const std::optional<std::string>& Row::at(std::string_view column) const {
  const auto found = std::ranges::find(table->columns, column, &Column::name);
  BARAKA_CHECK(found != table->columns.end());
  return cells[static_cast<std::size_t>(found - table->columns.begin())];
}

std::int64_t Row::integer(std::string_view column) const {
  const std::string digits = text(column);
  std::int64_t value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value;
}

std::optional<Row> find_row(RunReader& run, std::string_view table, std::string_view column,
                            std::int64_t value) {
  const Table& searched = table_called(table);
  Statement found = run.query(fmt::format("{} WHERE {} = ? LIMIT 1", select_sql(searched), column));
  found.bind_all(value);
  if (!found.next()) return std::nullopt;
  return row_of(found, searched);
}

std::optional<RowDifference> first_different_row(RunReader& one, RunReader& other,
                                                 std::string_view table) {
  const Table& compared = table_called(table);
  Rows first(one, compared), second(other, compared);
  for (;;) {
    const bool has_first = first.next(), has_second = second.next();
    if (!has_first && !has_second) return std::nullopt;
    if (has_first && has_second && first.equals(second)) continue;
    return RowDifference{.before = first.before(), .first = first.row(), .second = second.row()};
  }
}

}  // namespace results::record
