#include "view/server/tiles.h"

namespace view::server {

using results::record::Statement;

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

// "complete" comes before everything that a run could influence.
bool is_complete(std::string_view tile) {
  return tile.substr(0, tile.find("\"columns\"")).find("\"complete\":true") !=
         std::string_view::npos;
}

Json bins_json(const Counts& counts) {
  return JsonObject().add("n", kBins).add("counts", json_array(counts)).json();
}

Json counts_of(Record& record, const std::string& table, const Rows& rows, const Span& span) {
  Counts counts{};
  Statement row =
      record.query("SELECT at_ns, rowid FROM " + table + " WHERE rowid >= ? AND rowid < ?");
  row.bind_all(rows.begin, rows.end);
  while (row.next()) {
    const std::int64_t at = row.integer(0);
    if (at < span.from() || at >= span.to()) row.refuse(0, kOutOfOrder);
    ++counts.at(bin_of(span, at));
  }
  return bins_json(counts);
}

}  // namespace view::server
