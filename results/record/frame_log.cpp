#include "results/record/frame_log.h"

#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "results/record/packet_name.h"
#include "sim/radio/frame_class.h"

namespace results::record {

FrameLog::FrameLog(Database& database, sim::scenario::Detail detail, const Protocols& protocols)
    : insert_(database, "INSERT INTO frames VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      insert_end_(database, "INSERT INTO frame_ends VALUES (?, ?, ?, ?, ?, ?)"),
      detail_(detail),
      protocols_(protocols) {}

bool FrameLog::takes(hal::Time at, const sim::radio::Frame& frame) {
  if (detail_ == sim::scenario::Detail::kAll) return true;
  const std::int64_t second = hal::to_ns(at) / 1'000'000'000;
  if (std::exchange(second_, second) != second) {
    rows_ = 0;
    left_out_.clear();
  }
  if (rows_ < kRowsOfSecond) return true;
  left_out_.insert(frame.id);
  return false;
}

int FrameLog::on_start(hal::Time at, const sim::radio::Frame& frame) {
  if (!takes(at, frame)) return 0;
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
              frame.airtime.count(), frame.duration.count(), rate, sender, message, kind);
  ++rows_;
  return 1;
}

int FrameLog::on_reception(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                           hal::Verdict verdict, double rssi_dbm) {
  const double sinr_db = std::exchange(sinr_db_, std::numeric_limits<double>::quiet_NaN());
  if (left_out_.contains(frame.id)) return 0;
  std::optional<double> sinr;
  if (!std::isnan(sinr_db)) sinr = sinr_db;
  insert_end_.run(frame.id, receiver.value, hal::to_ns(at), hal::name(verdict), rssi_dbm, sinr);
  ++rows_;
  return 1;
}

}  // namespace results::record
