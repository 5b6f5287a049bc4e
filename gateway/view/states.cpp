#include <fmt/format.h>

#include "gateway/view/row_values.h"
#include "gateway/view/tiles.h"

namespace gateway::view {
namespace {

using sim::record::Statement;

const std::string kNameOf = "IFNULL((SELECT name FROM agents WHERE agent = {0}), {0})";

/// What happened, of all tables that tell of single things: at_ns, kind, agent, text.
std::string events_sql(const Record& record) {
  std::string sql;
  const auto add = [&](const char* table, const std::string& select) {
    if (!record.has(table)) return;
    sql += (sql.empty() ? "SELECT " : " UNION ALL SELECT ") + select + " FROM " + table;
  };
  const auto name = [](const char* column) { return fmt::format(fmt::runtime(kNameOf), column); };
  add("discoveries", "ended_ns AS at_ns, 'discovery' AS kind, agent, topic || ' to ' || " +
                         name("destination") +
                         " || CASE found WHEN 0 THEN ': given up after ' ELSE ': found after ' END"
                         " || printf('%.3f ms', took_ns / 1e6) AS text");
  add("events", "at_ns, 'scripted', agent, action");
  add("lost_bodies", "at_ns, 'lost body', agent, what");
  add("contacts", "at_ns, 'contact', agent, 'with a ' || other");
  add("associations",
      "at_ns, 'association', station, CASE WHEN access_point IS NULL THEN 'none'"
      " ELSE 'with ' || " +
          name("access_point") + " END");
  add("arrivals", "at_ns, 'arrival', NULL, door");
  return "(" + sql + ")";
}

}  // namespace

std::string states_tile(Record& record, const Span& span) {
  Columns columns({"agent", "at", "state"});
  Statement before = record.query(
      "SELECT agent, at_ns, state, MAX(rowid) FROM states WHERE at_ns < ? GROUP BY agent"
      " ORDER BY 2, 1");
  before.bind_all(span.from());
  while (before.next()) columns.add(before.integer(0), before.integer(1), before.text(2));
  if (count_rows(record, "states", span, kMostRows + 1) > kMostRows) {
    const Json bins =
        counts_of(record, "SELECT at_ns FROM states WHERE at_ns >= ? AND at_ns < ?", span);
    return tile_text(record, span, false, columns, {{"bins", bins}});
  }
  Statement rows = record.query(
      "SELECT agent, at_ns, state FROM states WHERE at_ns >= ? AND at_ns < ? ORDER BY at_ns, "
      "agent, rowid");
  rows.bind_all(span.from(), span.to());
  while (rows.next()) columns.add(rows.integer(0), rows.integer(1), rows.text(2));
  return tile_text(record, span, true, columns);
}

std::string events_tile(Record& record, const Span& span) {
  Columns columns({"at", "kind", "agent", "text"});
  const std::string all = events_sql(record);
  if (count_rows(record, all, span, kMostRows + 1) > kMostRows) {
    const Json bins =
        counts_of(record, "SELECT at_ns FROM " + all + " WHERE at_ns >= ? AND at_ns < ?", span);
    return tile_text(record, span, false, columns, {{"bins", bins}});
  }
  Statement rows = record.query("SELECT at_ns, kind, agent, text FROM " + all +
                                " WHERE at_ns >= ? AND at_ns < ? ORDER BY at_ns, agent, kind");
  rows.bind_all(span.from(), span.to());
  while (rows.next()) {
    columns.add(rows.integer(0), rows.text(1), integer_at(rows, 2), rows.text(3));
  }
  return tile_text(record, span, true, columns);
}

}  // namespace gateway::view
