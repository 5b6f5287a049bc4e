#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/types/agent_id.h"

namespace hal::node::routing {

/// One item of `routes` in a file: either a row for some nodes, or a path. `at` and `to` are names
/// of nodes or patterns with `*` and `?`, as are the items of `path`.
struct StaticRow {
  std::string at = "*";           ///< The nodes that have the route.
  std::string to;                 ///< The destinations; empty: this is a path.
  std::string via;                ///< Name of the next hop; empty: the destination itself.
  std::vector<std::string> path;  ///< Each node reaches all others along the path, both ways.
};

/// One route of a node.
struct StaticRoute {
  AgentId to;   ///< Destination, never the node itself.
  AgentId via;  ///< Next hop, never the node itself; `to`: a neighbour.
  std::uint16_t hops =
      0;  ///< Links up to the destination; 0: the routes lead only part of the way.
  bool operator==(const StaticRoute&) const = default;
};

/// Parameters of static routing.
struct StaticConfig {
  std::vector<StaticRow> rows;      ///< As in the file, for all nodes.
  std::vector<StaticRoute> routes;  ///< Of this node, by destination, each at most once.
};

template <class Fields>
void row_keys(Fields& io, StaticRow& row) {
  io.text({"at", "Agents that have the route: a name, or a pattern with *.", "NAME0"}, row.at);
  io.needed_text({"to", "Destinations of the route: a name, or a pattern with *.", "NAME*"},
                 row.to);
  io.given_text({"via",
                 "Agent to which messages for these destinations are sent first; without it, they "
                 "are sent directly to their destination.",
                 "NAME1"},
                row.via);
}

/// Keys of `algorithm: static`.
template <class Fields>
void keys_of(Fields& io, StaticConfig& c) {
  io.template list<StaticRow>(
      {"routes",
       "Next hops of all agents. If several items give an agent a route to the same destination, "
       "the last one counts. Where `at` is a pattern, the destination and `via` themselves are "
       "left out.",
       "[{path: [NAME0, NAME1]}, {at: NAME0, to: NAME*, via: NAME1}]"},
      c.rows, [](Fields& one, StaticRow& row) {
        const bool is_path = row.to.empty();
        const auto path = [&row](Fields& keys) {
          keys.texts({"path",
                      "Agents along which messages travel in both directions: each reaches all "
                      "others by the next one on the path. A pattern stands for the agents that "
                      "match it, by address.",
                      "[NAME0, NAME1]"},
                     row.path);
        };
        const auto hop = [&row](Fields& keys) { row_keys(keys, row); };
        if (one.first_of({{"path", is_path, path}, {"to", !is_path, hop}})) return;
        one.mistake("", "must have either `to` or `path`");
        if (one.reading() != nullptr) one.reading()->leave_rest();
      });
}

}  // namespace hal::node::routing
