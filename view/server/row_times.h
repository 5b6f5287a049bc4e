#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "view/server/record.h"
#include "view/server/tile.h"

namespace view::server {

/// Rows of a table: rowids begin <= rowid < end.
struct Rows {
  std::int64_t begin = 0, end = 0;

  std::int64_t count() const { return end - begin; }
};

/// The error of a row whose time is not between those of its neighbours.
inline constexpr std::string_view kOutOfOrder = "out of order: rows are written as time goes on";

/// The rows of the time span from <= at_ns < to [ns]. The table's rows must have been written in
/// order of time, and none may ever have been removed, so that a binary search over rowid finds
/// them without an index.
Rows rows_between(Record& record, const std::string& table, std::int64_t from, std::int64_t to);
inline Rows rows_in(Record& record, const std::string& table, const Span& span) {
  return rows_between(record, table, span.from(), span.to());
}

}  // namespace view::server
