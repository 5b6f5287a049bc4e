#include "sim/record/frame_counts.h"

#include "sim/record/frame_class.h"

namespace sim::record {

FrameCounts::FrameCounts(Database& database)
    : put_sent_(database, "REPLACE INTO frames_sent VALUES (?, ?, ?, ?)"),
      put_reception_(database, "REPLACE INTO receptions VALUES (?, ?, ?, ?, ?, ?)"),
      put_packet_(database, "REPLACE INTO packets VALUES (?, ?, ?, ?)"),
      put_request_(database, "REPLACE INTO requests VALUES (?, ?, ?, ?)") {}

void FrameCounts::on_frame_start(const radio::Frame& frame) {
  sent_.add({{frame.transmitter, frame.receiver}, class_of(frame)});
}

void FrameCounts::on_reception(const radio::Frame& frame, hal::AgentId receiver,
                               hal::Verdict verdict) {
  const bool addressed = frame.is_broadcast() || frame.receiver == receiver;
  receptions_.add({{receiver, frame.transmitter}, class_of(frame), addressed, verdict});
}

void FrameCounts::on_delivered(const radio::Frame& frame, hal::AgentId receiver) {
  packets_.add({{receiver, frame.transmitter}, class_of(frame)});
}

void FrameCounts::on_request_end(hal::AgentId sender, hal::AgentId destination,
                                 hal::Verdict verdict) {
  requests_.add({{sender, destination}, verdict});
}

void FrameCounts::write() {
  sent_.write_changes([this](const auto& key, std::uint64_t count) {
    const auto& [pair, kind] = key;
    put_sent_.run(pair.first.value, pair.second.value, kind, count);
  });
  receptions_.write_changes([this](const auto& key, std::uint64_t count) {
    const auto& [pair, kind, addressed, verdict] = key;
    put_reception_.run(pair.first.value, pair.second.value, kind, addressed, hal::name(verdict),
                       count);
  });
  packets_.write_changes([this](const auto& key, std::uint64_t count) {
    const auto& [pair, kind] = key;
    put_packet_.run(pair.first.value, pair.second.value, kind, count);
  });
  requests_.write_changes([this](const auto& key, std::uint64_t count) {
    const auto& [pair, verdict] = key;
    const bool unknown = pair.second == hal::kEveryone && verdict == hal::Verdict::kDelivered;
    put_request_.run(pair.first.value, pair.second.value,
                     unknown ? "transmitted" : hal::name(verdict), count);
  });
}

}  // namespace sim::record
