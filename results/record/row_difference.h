#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/record/run_reader.h"
#include "results/record/schema.h"

namespace results::record {

/// One row of a table, as texts that are equal exactly if the values are.
struct Row {
  const Table* table = nullptr;
  std::vector<std::optional<std::string>> cells;  ///< By column; nullopt: null.

  /// @pre the table has this column.
  const std::optional<std::string>& at(std::string_view column) const;
  /// The text, or "" for null.
  std::string text(std::string_view column) const { return at(column).value_or(""); }
  /// The number; 0 for null. @pre the column has whole numbers.
  std::int64_t integer(std::string_view column) const;
};

/// The first row of a table whose column, or rowid, has a value; nullopt if there is none.
/// @throws std::runtime_error  as RunReader.
std::optional<Row> find_row(RunReader& run, std::string_view table, std::string_view column,
                            std::int64_t value);

/// The first row in which a table of two runs differs.
struct RowDifference {
  std::optional<Row> before;         ///< The row before it, which both have.
  std::optional<Row> first, second;  ///< nullopt: that run has no more rows.
};

/// Compares a table of two runs row by row, in the order in which the rows were written.
/// @param table  with rowid.
/// @return nullopt: the tables are equal.
/// @throws std::runtime_error  as RunReader.
std::optional<RowDifference> first_different_row(RunReader& one, RunReader& other,
                                                 std::string_view table);

}  // namespace results::record
