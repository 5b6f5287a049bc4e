#include <fmt/format.h>

#include "view/server/row_values.h"
#include "view/server/tiles.h"

namespace view::server {
namespace {

using results::record::Statement;

const std::string kNameOf = "IFNULL((SELECT name FROM agents WHERE agent = {0}), {0})";

/// A UNION of all tables of single events: at_ns, kind, agent, text.
std::string events_sql() {
  std::string sql;
  const auto add = [&](const char* table, const std::string& select) {
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

std::string events_tile(Record& record, const Span& span) {
  Columns columns({"at", "kind", "agent", "text"});
  Statement rows = record.query("SELECT at_ns, kind, agent, text FROM " + events_sql() +
                                " WHERE at_ns >= ? AND at_ns < ? ORDER BY at_ns, agent, kind");
  rows.bind_all(span.from(), span.to());
  Counts counts{};
  while (rows.next()) {
    ++counts.at(bin_of(span, rows.integer(0)));
    columns.add(rows.integer(0), rows.text(1), integer_at(rows, 2), rows.text(3));
  }
  if (static_cast<std::int64_t>(columns.rows()) <= kMostRows) {
    return tile_text(record, span, true, columns);
  }
  return tile_text(record, span, false, Columns({"at", "kind", "agent", "text"}),
                   {{"bins", bins_json(counts)}});
}

}  // namespace view::server
