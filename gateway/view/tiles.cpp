#include "gateway/view/tiles.h"

#include <fmt/format.h>

namespace gateway::view {

using sim::record::Statement;

std::string tile_text(const Record& record, const Span& span, bool is_complete,
                      const Columns& columns,
                      std::initializer_list<std::pair<std::string_view, Json>> more) {
  JsonObject tile;
  tile.add("from", span.from())
      .add("to", span.to())
      .add("until", record.until())
      .add("complete", is_complete)
      .add("columns", columns.json());
  for (const auto& [name, value] : more) tile.add(name, value);
  return tile.json().text;
}

// It comes before everything that a run could have a say in.
bool is_complete(std::string_view tile) {
  return tile.substr(0, tile.find("\"columns\"")).find("\"complete\":true") !=
         std::string_view::npos;
}

std::int64_t count_rows(Record& record, const std::string& table, const Span& span,
                        std::int64_t most) {
  Statement count = record.query(fmt::format(
      "SELECT COUNT(*) FROM (SELECT 1 FROM {} WHERE at_ns >= ? AND at_ns < ? LIMIT ?)", table));
  count.bind_all(span.from(), span.to(), most);
  return count.next() ? count.integer(0) : 0;
}

Json bins_json(const Counts& counts) {
  return JsonObject().add("n", kBins).add("counts", json_array(counts)).json();
}

Json counts_of(Record& record, const std::string& times, const Span& span) {
  Counts counts{};
  Statement rows = record.query(times);
  rows.bind_all(span.from(), span.to());
  while (rows.next()) ++counts.at(bin_of(span, rows.integer(0)));
  return bins_json(counts);
}

}  // namespace gateway::view
