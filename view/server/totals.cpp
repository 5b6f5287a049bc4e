#include <fmt/format.h>

#include <string>

#include "view/server/row_values.h"
#include "view/server/tiles.h"

namespace view::server {
namespace {

using results::record::Statement;

/// {"name": count, …} from a query of names and counts for an agent.
Json counts_by_name(Record& record, const std::string& sql, std::int64_t agent) {
  JsonObject counts;
  Statement row = record.query(sql);
  row.bind_all(agent);
  while (row.next()) counts.add(row.text(0), row.integer(1));
  return counts.json();
}

/// The columns of the agent's only row, by name; {} if it has none.
Json row_of(Record& record, const std::string& table, std::initializer_list<const char*> columns,
            std::int64_t agent) {
  std::string names;
  for (const char* column : columns) names += (names.empty() ? "" : ", ") + std::string(column);
  Statement row = record.query(fmt::format("SELECT {} FROM {} WHERE agent = ?", names, table));
  row.bind_all(agent);
  JsonObject values;
  if (!row.next()) return values.json();
  int i = 0;
  for (const char* column : columns) {
    if (row.is_real(i)) {
      values.add(column, row.real(i));
    } else {
      values.add(column, integer_at(row, i));
    }
    ++i;
  }
  return values.json();
}

}  // namespace

std::string totals_json(Record& record, std::int64_t agent) {
  const auto count = [&](const char* sql) { return counts_by_name(record, sql, agent); };
  return JsonObject()
      .add("agent", agent)
      .add("until", record.until())
      .add("frames_sent",
           count("SELECT class, SUM(count) FROM frames_sent WHERE agent = ? GROUP BY 1"))
      .add("receptions", count("SELECT verdict, SUM(count) FROM receptions WHERE agent = ? AND "
                               "addressed = 1 GROUP BY 1"))
      .add("overheard", count("SELECT verdict, SUM(count) FROM receptions WHERE agent = ? AND "
                              "addressed = 0 GROUP BY 1"))
      .add("packets", count("SELECT class, SUM(count) FROM packets WHERE agent = ? GROUP BY 1"))
      .add("requests", count("SELECT verdict, SUM(count) FROM requests WHERE agent = ? GROUP BY 1"))
      .add("relays", count("SELECT CASE destination WHEN 65535 THEN 'everyone' ELSE IFNULL((SELECT "
                           "name FROM agents a WHERE a.agent = destination), destination) END ||"
                           " ': ' || verdict, SUM(count) FROM relays WHERE agent = ? GROUP BY 1"))
      .add("relay_queues",
           count("SELECT CASE destination WHEN 65535 THEN 'everyone' ELSE IFNULL((SELECT name FROM"
                 " agents a WHERE a.agent = destination), destination) END || ': ' || what, n FROM"
                 " (SELECT agent, destination, 'waiting' AS what, waiting AS n FROM relay_queues"
                 " UNION ALL SELECT agent, destination, 'most', most FROM relay_queues)"
                 " WHERE agent = ? ORDER BY 1"))
      .add(
          "station_queues",
          count("SELECT CASE receiver WHEN 65535 THEN 'everyone' ELSE IFNULL((SELECT name FROM"
                " agents a WHERE a.agent = receiver), receiver) END || ' ' || category || ': ' ||"
                " what, n FROM (SELECT agent, receiver, category, 'waiting' AS what, waiting AS n"
                " FROM station_queues UNION ALL SELECT agent, receiver, category, 'most', most FROM"
                " station_queues UNION ALL SELECT agent, receiver, category, verdict, count FROM"
                " station_queue_drops) WHERE agent = ? ORDER BY 1"))
      .add("messages", count("SELECT verdict, SUM(count) FROM message_ends WHERE sender = ? GROUP "
                             "BY 1"))
      .add("routing", count("SELECT event, count FROM routing_events WHERE agent = ?"))
      .add("use", row_of(record, "agent_use",
                         {"transmitting_ns", "receiving_ns", "listening_ns", "off_ns", "retries",
                          "energy_j", "load_j"},
                         agent))
      .add("body",
           row_of(record, "bodies",
                  {"path_m", "clearance_m", "tilt_rad", "wall_steps", "object_steps"}, agent))
      .json()
      .text;
}

}  // namespace view::server
