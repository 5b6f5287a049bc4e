#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "results/record/database.h"

namespace view::server {

/// Columns of the current row that may be null.
inline std::optional<std::int64_t> integer_at(const results::record::Statement& row, int column) {
  if (row.is_null(column)) return std::nullopt;
  return row.integer(column);
}
inline std::optional<double> real_at(const results::record::Statement& row, int column) {
  if (row.is_null(column)) return std::nullopt;
  return row.real(column);
}
inline std::optional<std::string> text_at(const results::record::Statement& row, int column) {
  if (row.is_null(column)) return std::nullopt;
  return row.text(column);
}

}  // namespace view::server
