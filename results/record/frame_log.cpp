#include "results/record/frame_log.h"

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "results/record/packet_name.h"
#include "sim/air/packet_text.h"
#include "sim/core/fingerprint.h"
#include "sim/radio/mac/frame_class.h"

namespace results::record {
namespace {

/// Protocols of a program's packet; none if the frame carries none.
std::optional<std::string> protocol_of(const sim::radio::Frame& frame) {
  const bool is_packet = frame.type == sim::radio::FrameType::kData && frame.payload &&
                         frame.ethertype != sim::radio::kEthertypeRouting;
  if (!is_packet) return std::nullopt;
  return sim::air::packet_text(frame.ethertype, std::as_bytes(std::span(*frame.payload)));
}

std::optional<std::uint64_t> payload_hash_of(const sim::radio::Frame& frame) {
  if (!frame.payload) return std::nullopt;
  sim::Hash hash;
  hash.add_bytes(frame.payload->data(), frame.payload->size());
  return hash.value();
}

}  // namespace

FrameLog::FrameLog(Database& database, sim::scenario::Detail detail, const Protocols& protocols,
                   Commits& commits)
    : insert_(database,
              "INSERT INTO frames VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
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
  const hal::node::routing::FrameName packet = packet_name(frame, protocols_);
  std::optional<int> sender;
  std::optional<std::uint64_t> message;
  if (packet.message) {
    sender = packet.message->sender.value;
    message = packet.message->id;
  }
  std::optional<double> rate;
  if (frame.rate.value > 0) rate = frame.rate.value;
  std::optional<std::string_view> kind;
  if (!packet.kind.empty()) kind = packet.kind;
  insert_.run(frame.id, hal::to_ns(at), sim::radio::class_of(frame), frame.transmitter.value,
              frame.receiver.value, frame.sequence, frame.retry, std::uint64_t{frame.air_length},
              frame.airtime.count(), frame.duration.count(), rate, sender, message, kind,
              protocol_of(frame), payload_hash_of(frame));
  ++rows_;
  commits_.on_rows(at, 1);
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
  return {
      {"frames",
       "frames one by one: each with record: {frames: all}, with `sample` the first of each "
       "simulated "
       "second, until they and how they ended are 5000 rows",
       {{"frame", "INTEGER NOT NULL", "", "transmitter times 2^48 and its own count"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when it began"},
        {"class", "TEXT NOT NULL", "", "as in frames_sent"},
        {"transmitter", "INTEGER NOT NULL", "", "agent"},
        {"receiver", "INTEGER NOT NULL", "", "agent, or everyone"},
        {"sequence", "INTEGER NOT NULL", "", "number that the transmitter gave it"},
        {"retry", "INTEGER NOT NULL", "", "1: a retransmission"},
        {"bits", "INTEGER NOT NULL", "bit", "length on the air"},
        {"airtime_ns", "INTEGER NOT NULL", "ns", "from its begin to its end"},
        {"duration_ns", "INTEGER NOT NULL", "ns",
         "its Duration field: how long it reserves the medium after its end"},
        {"rate_bps", "INTEGER", "bit/s", "rate of the MPDU; null: the radio profile has no rates"},
        {"sender", "INTEGER", "",
         "sender of the controllers' message that the frame carries; null: it carries none"},
        {"message", "INTEGER", "", "number of that message, by its sender"},
        {"packet", "TEXT", "",
         "what routing sent in it: 'data', 'forward ant', ...; null: nothing"},
        {"protocol", "TEXT", "",
         "protocols and ports of the program's packet in it: 'ARP', 'IPv4 UDP 40000 > 5000', 'IPv6 "
         "TCP 40001 > 80', 'IPv4 UDP 7412 > 7410, RTPS', ...; null: it contains none"},
        {"payload_hash", "INTEGER", "",
         "hash of the bytes of its payload, 64 bits; null: it has no payload"}}},
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
