#include "sim/report/mcap_streams.h"

#include <utility>

#include "sim/report/ros_messages.h"

namespace sim::report {

McapStream::McapStream(record::RunReader& reader, std::string_view sql, OnRow on_row, AtEnd at_end)
    : rows_(reader.query(sql)),
      on_row_(std::move(on_row)),
      at_end_(std::move(at_end)),
      has_more_(rows_.next()) {}

void McapStream::take_instant() {
  const std::int64_t at = at_ns();
  while (has_more_ && at_ns() == at) {
    on_row_(at, rows_);
    has_more_ = rows_.next();
  }
  if (at_end_) at_end_(at);
}

std::string McapParts::name(std::int64_t agent) const {
  const auto found = names.find(agent);
  return found == names.end() ? std::string() : found->second;
}

void add_network_streams(const McapParts& parts, McapStreams& streams) {
  streams.push_back(std::make_unique<McapStream>(
      parts.reader,
      "SELECT at_ns, transmitter, receiver, class, sequence, retry, bits, airtime_ns FROM frames"
      " ORDER BY at_ns, frame",
      [parts](std::int64_t at, const record::Statement& row) {
        const std::string kind = row.text(3);
        const bool is_data = kind == "broadcast" || kind == "unicast";
        parts.topics.publish(at, "/baraka/frames", "baraka_msgs/msg/Frame",
                             frame_message({.at_ns = at,
                                            .transmitter = parts.name(row.integer(1)),
                                            .receiver = parts.name(row.integer(2)),
                                            .type = is_data ? "data" : kind,
                                            .sequence = static_cast<std::uint16_t>(row.integer(4)),
                                            .retry = row.integer(5) != 0,
                                            .bits = static_cast<std::uint32_t>(row.integer(6)),
                                            .airtime_ns = row.integer(7)}));
      }));
  // As its sender was told, and as copies arrived: when others ended is not in the record.
  streams.push_back(std::make_unique<McapStream>(
      parts.reader,
      "SELECT fate_ns, sender, id, sender AS node, fate, '' FROM messages WHERE fate IS NOT NULL"
      " UNION ALL SELECT at_ns, sender, id, receiver, '', 'delivered' FROM deliveries"
      " ORDER BY 1, 2, 3, 4",
      [parts](std::int64_t at, const record::Statement& row) {
        parts.topics.publish(at, "/baraka/message_fates", "baraka_msgs/msg/MessageFate",
                             message_fate({.at_ns = at,
                                           .sender = parts.name(row.integer(1)),
                                           .id = static_cast<std::uint32_t>(row.integer(2)),
                                           .node = parts.name(row.integer(3)),
                                           .fate = row.text(4),
                                           .verdict = row.text(5)}));
      }));
}

void add_route_stream(const McapParts& parts, McapStreams& streams) {
  streams.push_back(std::make_unique<McapStream>(
      parts.reader,
      "SELECT at_ns, agent, topic, destination, next_hop, hops, delay_ns, min_snr_db, energy_j"
      " FROM routes ORDER BY at_ns, rowid",
      [parts](std::int64_t at, const record::Statement& row) {
        parts.topics.publish(at, "/baraka/routes", "baraka_msgs/msg/Route",
                             route_message({.at_ns = at,
                                            .agent = parts.name(row.integer(1)),
                                            .topic = row.text(2),
                                            .destination = parts.name(row.integer(3)),
                                            .next_hop = parts.name(row.integer(4)),
                                            .removed = row.is_null(5),
                                            .hops = static_cast<std::uint16_t>(row.integer(5)),
                                            .delay_ns = row.integer(6),
                                            .min_snr_db = row.real(7),
                                            .energy = row.real(8)}));
      }));
}

void add_controller_streams(const McapParts& parts, McapStreams& streams) {
  streams.push_back(std::make_unique<McapStream>(
      parts.reader, "SELECT at_ns, agent, state FROM states ORDER BY at_ns, rowid",
      [parts](std::int64_t at, const record::Statement& row) {
        parts.topics.publish(at, "/baraka/controller_states", "baraka_msgs/msg/ControllerState",
                             controller_state(at, parts.name(row.integer(1)), row.text(2)));
      }));
  streams.push_back(std::make_unique<McapStream>(
      parts.reader, "SELECT at_ns, agent, name, value FROM recorded ORDER BY at_ns, rowid",
      [parts](std::int64_t at, const record::Statement& row) {
        parts.topics.publish(
            at, "/baraka/values", "baraka_msgs/msg/Value",
            value_message(at, parts.name(row.integer(1)), row.text(2), row.real(3)));
      }));
}

}  // namespace sim::report
