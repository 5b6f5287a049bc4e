#include "results/record/frame_log.h"

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "results/record/frame_ppdu.h"
#include "results/record/packet_name.h"
#include "sim/air/packet_text.h"
#include "sim/core/fingerprint.h"
#include "sim/radio/mac/frame_class.h"

namespace results::record {
namespace {

/// What routing sent, as columns: sender and number of a message, and kind of the packet.
struct PacketColumns {
  explicit PacketColumns(const hal::node::routing::FrameName& packet) {
    if (packet.message) {
      sender = packet.message->sender.value;
      message = packet.message->id;
    }
    if (!packet.kind.empty()) kind = packet.kind;
  }
  std::optional<int> sender{};
  std::optional<std::uint64_t> message{};
  std::optional<std::string_view> kind{};
};

/// Protocols of a program's packet; none if it is not one.
std::optional<std::string> protocol_of(sim::radio::Ethertype type,
                                       const sim::radio::Payload& payload) {
  if (!payload || type == sim::radio::kEthertypeRouting) return std::nullopt;
  return sim::air::packet_text(type, std::as_bytes(std::span(*payload)));
}

std::optional<std::string> protocol_of(const sim::radio::Frame& frame) {
  if (frame.type != sim::radio::FrameType::kData) return std::nullopt;
  return protocol_of(frame.ethertype, frame.payload);
}

std::uint64_t payload_hash_of(const hal::Bytes& payload) {
  sim::Hash hash;
  hash.add_bytes(payload.data(), payload.size());
  return hash.value();
}

/// Of an A-MSDU: of the bytes of all its MSDUs.
std::optional<std::uint64_t> payload_hash_of(const sim::radio::Frame& frame) {
  if (!frame.payload) return std::nullopt;
  if (!frame.amsdu) return payload_hash_of(*frame.payload);
  sim::Hash hash;
  for (const sim::radio::AmsduPart& part : *frame.amsdu) hash.add(payload_hash_of(*part.payload));
  return hash.value();
}

/// The columns of the tables frames and msdus about what a frame, or an MSDU, carries.
std::vector<Column> content_columns() {
  return {
      {"sender", "INTEGER", "",
       "sender of the controllers' message that it carries; null: it carries none"},
      {"message", "INTEGER", "", "number of that message, by its sender"},
      {"packet", "TEXT", "", "what routing sent in it: 'data', 'forward ant', ...; null: nothing"},
      {"protocol", "TEXT", "",
       "protocols and ports of the program's packet in it: 'ARP', 'IPv4 UDP 40000 > 5000', "
       "'IPv6 TCP 40001 > 80', 'IPv4 UDP 7412 > 7410, RTPS', ...; null: it contains none"},
      {"payload_hash", "INTEGER", "",
       "hash of the bytes of its payload, 64 bits; null: it has no payload"}};
}

void append(std::vector<Column>& columns, const std::vector<Column>& more) {
  columns.insert(columns.end(), more.begin(), more.end());
}

}  // namespace

FrameLog::FrameLog(Database& database, sim::scenario::Detail detail, const Protocols& protocols,
                   Commits& commits)
    : insert_(database,
              "INSERT INTO frames VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?,"
              " ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      insert_msdu_(database, "INSERT INTO msdus VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      insert_end_(database, "INSERT INTO frame_ends VALUES (?, ?, ?, ?, ?, ?)"),
      detail_(detail),
      protocols_(protocols),
      commits_(commits) {}

bool FrameLog::takes(hal::Time at, const sim::radio::Frame& frame) {
  if (detail_ == sim::scenario::Detail::kAll) return true;
  const std::int64_t second = hal::to_ns(at) / 1'000'000'000;
  if (std::exchange(second_, second) != second) {
    rows_ = 0;
    left_out_before_ = std::exchange(left_out_, {});
  }
  if (rows_ < kRowsOfSecond) return true;
  left_out_.insert(frame.id);
  return false;
}

void FrameLog::on_frame_start(hal::Time at, const sim::radio::Frame& frame) {
  if (!takes(at, frame)) return;
  const PacketColumns packet(packet_name(frame, protocols_));
  const FramePpdu ppdu(frame);
  std::optional<double> rate;
  if (frame.rate.value > 0) rate = frame.rate.value;
  insert_.run(frame.id, hal::to_ns(at), sim::radio::class_of(frame), frame.transmitter.value,
              frame.receiver.value, frame.sequence, frame.retry, std::uint64_t{frame.air_length},
              frame.airtime.count(), frame.duration.count(), rate, packet.sender, packet.message,
              packet.kind, protocol_of(frame), payload_hash_of(frame), std::uint64_t{frame.ampdu},
              frame.ppdu_airtime().count(), ppdu.modulation, ppdu.mcs, ppdu.streams, ppdu.width_mhz,
              ppdu.guard_ns, ppdu.tid, ppdu.category, ppdu.msdus, ppdu.block_ack);
  if (frame.amsdu) list_msdus(frame);
  ++rows_;
  commits_.on_rows(at, 1);
}

void FrameLog::list_msdus(const sim::radio::Frame& frame) {
  int place = 0;
  for (const sim::radio::AmsduPart& part : *frame.amsdu) {
    const PacketColumns packet(packet_name(part, protocols_));
    insert_msdu_.run(frame.id, ++place, part.source.value, part.destination.value, packet.sender,
                     packet.message, packet.kind, protocol_of(part.ethertype, part.payload),
                     payload_hash_of(*part.payload));
  }
}

void FrameLog::on_reception(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                            hal::Verdict verdict, double rssi_dbm) {
  const double sinr_db = std::exchange(sinr_db_, std::numeric_limits<double>::quiet_NaN());
  if (left_out_.contains(frame.id) || left_out_before_.contains(frame.id)) return;
  std::optional<double> sinr;
  if (!std::isnan(sinr_db)) sinr = sinr_db;
  insert_end_.run(frame.id, receiver.value, hal::to_ns(at), hal::name(verdict), rssi_dbm, sinr);
  ++rows_;
  commits_.on_rows(at, 1);
}

std::vector<Table> FrameLog::tables() {
  std::vector<Column> frames = {
      {"frame", "INTEGER NOT NULL", "", "transmitter times 2^48 and its own count"},
      {"at_ns", "INTEGER NOT NULL", "ns", "when it began; in an A-MPDU, when that began"},
      {"class", "TEXT NOT NULL", "", "as in frames_sent"},
      {"transmitter", "INTEGER NOT NULL", "", "agent"},
      {"receiver", "INTEGER NOT NULL", "", "agent, or everyone"},
      {"sequence", "INTEGER NOT NULL", "", "number that the transmitter gave it"},
      {"retry", "INTEGER NOT NULL", "", "1: a retransmission"},
      {"bits", "INTEGER NOT NULL", "bit", "length on the air"},
      {"airtime_ns", "INTEGER NOT NULL", "ns",
       "from its begin to its end; in an A-MPDU its part of ppdu_ns, to which the parts add up"},
      {"duration_ns", "INTEGER NOT NULL", "ns",
       "its Duration field: how long it reserves the medium after its end"},
      {"rate_bps", "INTEGER", "bit/s", "rate of the MPDU; null: the radio profile has no rates"}};
  append(frames, content_columns());
  frames.push_back({"ampdu", "INTEGER NOT NULL", "",
                    "number of its A-MPDU among those of the transmitter; 0: it is in none"});
  frames.push_back({"ppdu_ns", "INTEGER NOT NULL", "ns", "airtime of what it was sent in"});
  append(frames, FramePpdu::columns());
  std::vector<Column> msdus = {{"frame", "INTEGER NOT NULL", "", "as in frames"},
                               {"place", "INTEGER NOT NULL", "", "in the A-MSDU, from 1"},
                               {"source", "INTEGER NOT NULL", "", "agent"},
                               {"destination", "INTEGER NOT NULL", "", "agent, or everyone"}};
  append(msdus, content_columns());
  return {
      {"frames",
       "frames one by one: each with record: {frames: all}, with `sample` the first of each "
       "simulated second, until they and how they ended are 5000 rows. An A-MPDU is as many "
       "frames as it has MPDUs",
       frames},
      {"msdus",
       "MSDUs of the A-MSDUs among the frames of the table frames, which names the content of the "
       "first of each",
       msdus},
      {"frame_ends",
       "outcome of the frames of the table frames at the radios that could receive or sense them",
       {{"frame", "INTEGER NOT NULL", "", "as in frames"},
        {"agent", "INTEGER NOT NULL", "", "receiver"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when it ended there"},
        {"verdict", "TEXT NOT NULL", "", "how"},
        {"rssi_dbm", "REAL", "dBm", "power received"},
        {"sinr_db", "REAL", "dB",
         "lowest over the frame; null: the radio was not synchronised to it"}}},
  };
}

}  // namespace results::record
