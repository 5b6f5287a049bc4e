#include "results/report/mcap_streams.h"

#include <utility>

#include "idl/ros/values.h"

namespace results::report {
namespace {

using idl::ros::to_ros;

std::string text_or_empty(const record::Statement& row, int column) {
  return row.is_null(column) ? std::string() : row.text(column);
}

baraka_msgs::msg::dds_::Frame_ frame_of(const McapParts& parts, std::int64_t at,
                                        const record::Statement& row) {
  const std::string kind = row.text(3);
  const bool is_data = kind == "broadcast" || kind == "unicast";
  baraka_msgs::msg::dds_::Frame_ frame;
  frame.stamp(to_ros(hal::time_from_ns(at)));
  frame.transmitter(parts.name(row.integer(1)));
  frame.receiver(parts.name(row.integer(2)));
  frame.frame_type(is_data ? "data" : kind);
  frame.sequence_number(static_cast<std::uint16_t>(row.integer(4)));
  frame.retry(row.integer(5) != 0);
  frame.bits(static_cast<std::uint32_t>(row.integer(6)));
  frame.airtime(to_ros(hal::Duration(row.integer(7))));
  frame.rate(row.is_null(8) ? 0 : row.real(8));
  frame.modulation(text_or_empty(row, 9));
  frame.mcs(static_cast<std::int16_t>(row.is_null(10) ? -1 : row.integer(10)));
  frame.streams(static_cast<std::uint16_t>(row.integer(11)));
  frame.width(static_cast<std::uint16_t>(row.integer(12)));
  frame.guard_interval(static_cast<std::uint16_t>(row.integer(13)));
  frame.access_category(text_or_empty(row, 14));
  frame.ampdu(static_cast<std::uint32_t>(row.integer(15)));
  return frame;
}

baraka_msgs::msg::dds_::MessageFate_ fate_of(const McapParts& parts, std::int64_t at,
                                             const record::Statement& row) {
  baraka_msgs::msg::dds_::MessageFate_ fate;
  fate.stamp(to_ros(hal::time_from_ns(at)));
  fate.sender(parts.name(row.integer(1)));
  fate.id(static_cast<std::uint32_t>(row.integer(2)));
  fate.node(parts.name(row.integer(3)));
  fate.fate(row.text(4));
  fate.verdict(row.text(5));
  return fate;
}

baraka_msgs::msg::dds_::Route_ route_of(const McapParts& parts, std::int64_t at,
                                        const record::Statement& row) {
  baraka_msgs::msg::dds_::Route_ route;
  route.stamp(to_ros(hal::time_from_ns(at)));
  route.agent(parts.name(row.integer(1)));
  route.message_class(row.text(2));
  route.destination(parts.name(row.integer(3)));
  route.next_hop(parts.name(row.integer(4)));
  route.removed(row.is_null(5));
  route.hops(static_cast<std::uint16_t>(row.integer(5)));
  route.delay(to_ros(hal::Duration(row.integer(6))));
  route.min_snr_db(row.real(7));
  route.energy(row.real(8));
  return route;
}

baraka_msgs::msg::dds_::ControllerState_ state_of(const McapParts& parts, std::int64_t at,
                                                  const record::Statement& row) {
  baraka_msgs::msg::dds_::ControllerState_ state;
  state.stamp(to_ros(hal::time_from_ns(at)));
  state.agent(parts.name(row.integer(1)));
  state.state(row.text(2));
  return state;
}

baraka_msgs::msg::dds_::Value_ value_of(const McapParts& parts, std::int64_t at,
                                        const record::Statement& row) {
  baraka_msgs::msg::dds_::Value_ value;
  value.stamp(to_ros(hal::time_from_ns(at)));
  value.agent(parts.name(row.integer(1)));
  value.name(row.text(2));
  value.value(row.real(3));
  return value;
}

}  // namespace

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
      "SELECT at_ns, transmitter, receiver, class, sequence, retry, bits, airtime_ns, rate_bps,"
      " modulation, mcs, streams, width_mhz, guard_ns, category, ampdu FROM frames"
      " ORDER BY at_ns, frame",
      [parts](std::int64_t at, const record::Statement& row) {
        parts.topics.publish(at, "/baraka/frames", frame_of(parts, at, row));
      }));
  // Fates as senders were told, and arrivals of copies. The record does not say when other copies
  // ended.
  streams.push_back(std::make_unique<McapStream>(
      parts.reader,
      "SELECT fate_ns, sender, id, sender AS node, fate, '' FROM messages WHERE fate IS NOT NULL"
      " UNION ALL SELECT at_ns, sender, id, receiver, '', 'delivered' FROM deliveries"
      " ORDER BY 1, 2, 3, 4",
      [parts](std::int64_t at, const record::Statement& row) {
        parts.topics.publish(at, "/baraka/message_fates", fate_of(parts, at, row));
      }));
}

void add_route_stream(const McapParts& parts, McapStreams& streams) {
  streams.push_back(std::make_unique<McapStream>(
      parts.reader,
      "SELECT at_ns, agent, topic, destination, next_hop, hops, delay_ns, min_snr_db, energy_j"
      " FROM routes ORDER BY at_ns, rowid",
      [parts](std::int64_t at, const record::Statement& row) {
        parts.topics.publish(at, "/baraka/routes", route_of(parts, at, row));
      }));
}

void add_controller_streams(const McapParts& parts, McapStreams& streams) {
  streams.push_back(std::make_unique<McapStream>(
      parts.reader, "SELECT at_ns, agent, state FROM states ORDER BY at_ns, rowid",
      [parts](std::int64_t at, const record::Statement& row) {
        parts.topics.publish(at, "/baraka/controller_states", state_of(parts, at, row));
      }));
  streams.push_back(std::make_unique<McapStream>(
      parts.reader, "SELECT at_ns, agent, name, value FROM recorded ORDER BY at_ns, rowid",
      [parts](std::int64_t at, const record::Statement& row) {
        parts.topics.publish(at, "/baraka/values", value_of(parts, at, row));
      }));
}

}  // namespace results::report
