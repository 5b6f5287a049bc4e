#include "results/record/row_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "hal/types/agent_id.h"
#include "results/record/hexadecimal.h"
#include "sim/agents/air_door.h"
#include "sim/air/packet_text.h"
#include "sim/radio/mac/mac_address.h"

namespace results::record {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::array<std::string_view, 4> kAgents{"transmitter", "receiver", "agent", "sender"};

Bytes bytes_of(const Row& arrival) {
  return from_hexadecimal(arrival.text("bytes")).value_or(Bytes{});
}

bool is_packet(const Row& arrival) { return sim::agents::is_air_door(arrival.text("door")); }

std::string contents_of_frame(const Row& frame) {
  std::string text = fmt::format("{}, sequence {}, {} bit", frame.text("class"),
                                 frame.text("sequence"), frame.text("bits"));
  if (frame.text("retry") == "1") text += ", a retransmission";
  if (frame.at("rate_bps"))
    text += fmt::format(" at {} Mb/s", static_cast<double>(frame.integer("rate_bps")) / 1e6);
  return text + fmt::format(", lasts {} ns", frame.text("airtime_ns"));
}

std::string contents_of_end(const Row& end) {
  std::string text = end.text("verdict");
  if (end.at("rssi_dbm")) text += fmt::format(", {} dBm", end.text("rssi_dbm"));
  if (end.at("sinr_db")) text += fmt::format(", SINR {} dB", end.text("sinr_db"));
  return text;
}

/// "UDP payload, byte 0"; "" where the bytes are no packet.
std::string place_of(const Row& arrival, const Bytes& bytes, std::size_t at) {
  if (!is_packet(arrival)) return "";
  return sim::air::place_text(std::as_bytes(std::span(bytes)), at);
}

/// "byte 42 (UDP payload, byte 0)"
std::string byte_text(const std::string& place, std::size_t at) {
  return place.empty() ? fmt::format("byte {}", at) : fmt::format("byte {} ({})", at, place);
}

/// "; byte 45 (UDP payload, byte 3): 6c | 73": if the first byte that differs is in a header, which
/// may be a checksum, the first one that differs in what the headers are for.
std::string differing_payload(const Row& first, const Bytes& one, const Bytes& other,
                              std::size_t begin) {
  if (!place_of(first, one, begin).ends_with("header")) return "";
  for (std::size_t i = begin; i < std::min(one.size(), other.size()); ++i) {
    if (one[i] == other[i]) continue;
    const std::string place = place_of(first, one, i);
    if (place.find(", byte ") == std::string::npos) continue;
    return fmt::format("; {}: {:02x} | {:02x}", byte_text(place, i), one[i], other[i]);
  }
  return "";
}

std::string differing_bytes(const Row& first, const Row& second) {
  const Bytes one = bytes_of(first), other = bytes_of(second);
  const auto [a, b] = std::ranges::mismatch(one, other);
  std::string lengths = one.size() == other.size()
                            ? ""
                            : fmt::format("length {} | {} bytes", one.size(), other.size());
  if (a == one.end() || b == other.end()) return lengths;
  const auto at = static_cast<std::size_t>(a - one.begin());
  return fmt::format("{} of {}: {:02x} | {:02x}{}{}{}", byte_text(place_of(first, one, at), at),
                     one.size(), *a, *b, differing_payload(first, one, other, at),
                     lengths.empty() ? "" : ", ", lengths);
}

}  // namespace

RowWords::RowWords(RunReader& run) : run_(run) {
  Statement agents = run.query("SELECT agent, name FROM agents");
  while (agents.next()) names_[fmt::format("{}", agents.integer(0))] = agents.text(1);
}

std::string RowWords::name(const std::string& agent) const {
  if (agent == fmt::format("{}", hal::kEveryone.value)) return "everyone";
  if (agent == fmt::format("{}", hal::kNeighbours.value)) return "neighbours";
  const auto found = names_.find(agent);
  return found == names_.end() ? agent : found->second;
}

std::optional<Row> RowWords::frame_of(const Row& end) {
  return find_row(run_, "frames", "frame", end.integer("frame"));
}

std::string RowWords::stations_of_arrival(const Row& arrival) const {
  std::string door = arrival.text("door");
  if (!is_packet(arrival)) return door;
  std::string from = door.substr(sim::agents::kAirDoorPrefix.size());
  const Bytes frame = bytes_of(arrival);
  if (frame.size() < sim::radio::kAddressSize) return from;
  if (sim::radio::is_group(frame)) return from + " to everyone";
  const std::optional<hal::AgentId> to = sim::radio::get_address(frame);
  return to ? fmt::format("{} to {}", from, name(fmt::format("{}", to->value))) : from;
}

std::string RowWords::stations(const Row& row) {
  if (row.table->name == "arrivals") return stations_of_arrival(row);
  if (row.table->name == "frames") {
    return fmt::format("{} to {}", name(row.text("transmitter")), name(row.text("receiver")));
  }
  const std::optional<Row> frame = frame_of(row);
  return fmt::format("{}, at {}", frame ? stations(*frame) : "frame " + row.text("frame"),
                     name(row.text("agent")));
}

std::string RowWords::protocol(const Row& row) {
  if (row.table->name == "arrivals") {
    if (!is_packet(row)) return "input from outside";
    const Bytes frame = bytes_of(row);
    return sim::air::ethernet_text(std::as_bytes(std::span(frame)));
  }
  if (row.table->name == "frame_ends") {
    const std::optional<Row> frame = frame_of(row);
    return frame ? protocol(*frame) : "";
  }
  if (row.at("protocol")) return row.text("protocol");
  return row.text(row.at("packet") ? "packet" : "class");
}

std::string RowWords::contents(const Row& row) {
  if (row.table->name == "frames") return contents_of_frame(row);
  if (row.table->name == "frame_ends") return contents_of_end(row);
  return fmt::format("{} bytes from {}", row.text("bytes").size() / 2,
                     is_packet(row) ? "its interface" : "outside");
}

std::string RowWords::value(const Row& row, const Column& column) const {
  const std::optional<std::string>& cell = row.at(column.name);
  if (!cell) return "none";
  return std::ranges::find(kAgents, column.name) == kAgents.end() ? *cell : name(*cell);
}

std::string differing_values(const RowWords& one, const Row& first, const RowWords& other,
                             const Row& second) {
  const auto differing = [&](const Column& column) -> std::string {
    if (column.name == "bytes") return differing_bytes(first, second);
    if (column.name == "payload_hash") return "bytes of the payload (record.air records them)";
    return fmt::format("{} {} | {}", column.name, one.value(first, column),
                       other.value(second, column));
  };
  std::string text;
  for (const Column& column : first.table->columns) {
    if (column.name == "frame" || first.at(column.name) == second.at(column.name)) continue;
    text += (text.empty() ? "" : ", ") + differing(column);
  }
  if (!text.empty()) return text;
  return fmt::format("frame {} | {}", first.text("frame"), second.text("frame"));
}

}  // namespace results::record
