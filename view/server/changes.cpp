#include <charconv>
#include <string_view>

#include "view/server/last_rows.h"
#include "view/server/row_times.h"
#include "view/server/tiles.h"

namespace view::server {
namespace {

using results::record::Statement;

/// Converts "0.5 - 1e-3" to [0.5,null,0.001].
Json values_of(std::string_view reading) {
  JsonArray values;
  while (!reading.empty()) {
    const std::size_t end = std::min(reading.find(' '), reading.size());
    const std::string_view one = reading.substr(0, end);
    reading.remove_prefix(std::min(end + 1, reading.size()));
    double value = 0;
    const auto read = std::from_chars(one.data(), one.data() + one.size(), value);
    if (read.ec == std::errc{} && read.ptr == one.data() + one.size()) {
      values.add(value);
    } else {
      values.add(std::nullopt);
    }
  }
  return values.json();
}

/// A table of changes, and how its rows are sent to the page.
struct Changes {
  std::string table;
  std::string select;  ///< Its columns.
  Columns columns;
  void (*add)(Columns& to, const Statement& row);  ///< Adds a row of these columns.
};

/// A tile of changes: the last change of each thing before the span, and all changes in the span.
std::string tile_of_changes(Record& record, LastRows& last, const Span& span,
                            const Changes& changes) {
  const auto& [table, select, empty, add] = changes;
  Columns columns = empty;
  Statement row = record.query("SELECT " + select + " FROM " + table + " WHERE rowid = ?");
  for (const std::int64_t before : last.before(record, span.from())) {
    row.bind_all(before);
    while (row.next()) add(columns, row);
  }
  const Rows inside = rows_in(record, table, span);
  if (inside.count() > kMostRows) {
    const Json bins = counts_of(record, table, inside, span);
    return tile_text(record, span, false, columns, {{"bins", bins}});
  }
  Statement rows = record.query("SELECT " + select + " FROM " + table +
                                " WHERE rowid >= ? AND rowid < ? ORDER BY at_ns, agent, rowid");
  rows.bind_all(inside.begin, inside.end);
  while (rows.next()) add(columns, rows);
  return tile_text(record, span, true, columns);
}

}  // namespace

std::string readings_tile(Record& record, LastRows& last, const Span& span) {
  const Columns columns({"agent", "at", "channel", "values"});
  return tile_of_changes(record, last, span,
                         {"readings", "agent, at_ns, channel, reading", columns,
                          [](Columns& to, const Statement& row) {
                            to.add(row.integer(0), row.integer(1), row.text(2),
                                   values_of(row.text(3)));
                          }});
}

std::string states_tile(Record& record, LastRows& last, const Span& span) {
  const Columns columns({"agent", "at", "state"});
  return tile_of_changes(
      record, last, span,
      {"states", "agent, at_ns, state", columns, [](Columns& to, const Statement& row) {
         to.add(row.integer(0), row.integer(1), row.text(2));
       }});
}

std::string queues_tile(Record& record, LastRows& last, const Span& span) {
  const Columns columns({"agent", "at", "frames"});
  return tile_of_changes(
      record, last, span,
      {"queues", "agent, at_ns, frames", columns, [](Columns& to, const Statement& row) {
         to.add(row.integer(0), row.integer(1), row.integer(2));
       }});
}

}  // namespace view::server
