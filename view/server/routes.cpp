#include <fmt/format.h>

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "view/server/row_values.h"
#include "view/server/tiles.h"

namespace view::server {
namespace {

using results::record::Statement;

/// The entry of a routing table for one destination and next hop.
struct RouteEntry {
  std::optional<std::int64_t> hops, delay;
  std::optional<double> min_snr, energy, weight;
};

/// The entries for one destination and topic, by next hop.
using Ways = std::map<std::int64_t, RouteEntry>;

/// The probability with which a message takes a way: equation 1 of the paper. None if the protocol
/// does not choose by probability.
std::optional<double> probability_of(const RouteEntry& entry, const Ways& ways) {
  if (!entry.weight) return std::nullopt;
  double sum = 0;
  for (const auto& [next_hop, way] : ways) sum += way.weight.value_or(0);
  return sum > 0 ? std::optional(*entry.weight / sum) : std::nullopt;
}

class RouteRows {
 public:
  void add(const Statement& row) {
    const std::int64_t at = row.integer(0);
    const std::string topic = row.text(1);
    const std::int64_t destination = row.integer(2), next_hop = row.integer(3);
    Ways& ways = tables_[{topic, destination}];
    const auto write = [&](std::int64_t hop, const RouteEntry& entry, bool removed) {
      const auto probability = removed ? std::nullopt : probability_of(entry, ways);
      columns.add(at, topic, destination, hop, entry.hops, entry.delay, entry.min_snr, entry.energy,
                  entry.weight, probability, removed);
    };
    if (row.is_null(4)) {
      ways.erase(next_hop);
      write(next_hop, {}, true);
    } else {
      ways[next_hop] = {integer_at(row, 4), integer_at(row, 5), real_at(row, 6), real_at(row, 7),
                        real_at(row, 8)};
      write(next_hop, ways[next_hop], false);
    }
    // The probabilities of the other ways change as well.
    for (const auto& [hop, entry] : ways) {
      if (hop != next_hop && entry.weight) write(hop, entry, false);
    }
  }

  Columns columns{"at",      "topic",  "destination", "next_hop",    "hops",   "delay",
                  "min_snr", "energy", "weight",      "probability", "removed"};

 private:
  std::map<std::pair<std::string, std::int64_t>, Ways> tables_;
};

}  // namespace

std::string routes_json(Record& record, std::int64_t agent) {
  RouteRows rows;
  Statement row = record.query(
      "SELECT at_ns, topic, destination, next_hop, hops, delay_ns, min_snr_db, energy_j, weight "
      "FROM routes WHERE agent = ? ORDER BY at_ns, rowid");
  row.bind_all(agent);
  while (row.next()) rows.add(row);
  return JsonObject()
      .add("agent", agent)
      .add("until", record.until())
      .add("columns", rows.columns.json())
      .json()
      .text;
}

}  // namespace view::server
