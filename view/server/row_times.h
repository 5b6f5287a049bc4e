#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "view/server/record.h"
#include "view/server/tile.h"

namespace view::server {

/// Rows [begin, end) of a table by rowid.
struct Rows {
  std::int64_t begin = 0, end = 0;

  std::int64_t count() const { return end - begin; }
};

/// What is wrong with a row between others whose times are on one side of its own.
inline constexpr std::string_view kOutOfOrder = "out of order: rows are written as time goes on";

/// The rows of a span of time [from, to) ns, of a table whose rows were written one after the other
/// as time went on, and none of which is ever removed: no index is needed to find them.
Rows rows_between(Record& record, const std::string& table, std::int64_t from, std::int64_t to);
inline Rows rows_in(Record& record, const std::string& table, const Span& span) {
  return rows_between(record, table, span.from(), span.to());
}

}  // namespace view::server
