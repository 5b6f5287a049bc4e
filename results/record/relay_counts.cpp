#include "results/record/relay_counts.h"

#include <algorithm>
#include <string_view>

#include "sim/radio/mac/mac_sap.h"

namespace results::record {
namespace {

/// Verdict of a frame that reached its destination but could not be used: that station, or the
/// source, is not associated.
constexpr hal::Verdict kUnused = hal::Verdict::kNoRoute;

/// Frames to the access point itself, or from itself, are not relayed. The table also counts frames
/// that reached their destination and cannot be used there.
bool is_counted(const sim::radio::Msdu& msdu, const sim::radio::MsduEnd& end) {
  const bool is_used = msdu.request.destination == msdu.station && end.verdict != kUnused;
  return msdu.source != msdu.station && !is_used;
}

}  // namespace

RelayCounts::RelayCounts(Database& database)
    : put_relay_(database, "REPLACE INTO relays VALUES (?, ?, ?, ?, ?)"),
      forget_waiting_(database, "DELETE FROM relays WHERE verdict = 'waiting'"),
      put_queue_(database, "REPLACE INTO relay_queues VALUES (?, ?, ?, ?, ?, ?)") {}

void RelayCounts::on_relay_queued(hal::Time at, const sim::radio::Msdu& msdu) {
  changed_ = true;
  ++flows_[{msdu.station, msdu.source, msdu.request.destination}].waiting;
  Queue& queue = queues_[{msdu.station, msdu.request.destination}];
  queue.wait_until(at);
  ++queue.frames;
  queue.most = std::max(queue.most, ++queue.waiting);
}

void RelayCounts::on_msdu_end(hal::Time at, const sim::radio::Msdu& msdu,
                              const sim::radio::MsduEnd& end) {
  if (!is_counted(msdu, end)) return;
  changed_ = true;
  const hal::AgentId destination = msdu.request.destination;
  Flow& flow = flows_[{msdu.station, msdu.source, destination}];
  auto outcome = static_cast<std::size_t>(end.verdict);
  const bool is_group = destination == hal::kEveryone;
  if (end.went_over_wire) {
    outcome = kOverWire;
  } else if (is_group && end.verdict == hal::Verdict::kDelivered) {
    outcome = kTransmitted;
  }
  ++flow.ended[outcome];
  if (!end.has_waited) return;
  --flow.waiting;
  Queue& queue = queues_[{msdu.station, destination}];
  queue.wait_until(at);
  --queue.waiting;
}

void RelayCounts::write_flows() {
  forget_waiting_.run();
  for (const auto& [key, flow] : flows_) {
    const auto put = [this, &key = key](std::string_view verdict, std::uint64_t count) {
      const auto& [agent, source, destination] = key;
      if (count > 0) put_relay_.run(agent.value, source.value, destination.value, verdict, count);
    };
    for (std::size_t i = 0; i < kTransmitted; ++i)
      put(hal::name(static_cast<hal::Verdict>(i)), flow.ended[i]);
    put("transmitted", flow.ended[kTransmitted]);
    put("over the wire", flow.ended[kOverWire]);
    put("waiting", flow.waiting);
  }
}

void RelayCounts::write(hal::Time now) {
  if (!changed_) return;
  changed_ = false;
  write_flows();
  for (auto& [key, queue] : queues_) {
    // While frames wait, the row changes with time: write it again next time.
    changed_ = changed_ || queue.waiting > 0;
    queue.wait_until(std::max(now, queue.since));
    put_queue_.run(key.first.value, key.second.value, queue.frames, queue.waiting, queue.most,
                   queue.waited.count());
  }
}

std::vector<Table> RelayCounts::tables() {
  return {
      {"relays",
       "data frames that stations sent to an access point for forwarding, received over the air or "
       "over the wire: those forwarded and those that could not be; retransmissions do not count. "
       "Also frames that reached their destination but could not be used there",
       {{"agent", "INTEGER NOT NULL", "",
         "access point; with 'no route' also the destination itself, which acknowledged the frame "
         "but was not associated"},
        {"source", "INTEGER NOT NULL", "", "agent that originated it"},
        {"destination", "INTEGER NOT NULL", "", "agent that it is for, or everyone"},
        {"verdict", "TEXT NOT NULL", "",
         "'delivered': acknowledged by the destination; 'transmitted': broadcast in its BSS; 'over "
         "the wire': passed to another access point, where it is counted again; 'queue full'; "
         "'retry limit'; 'no route': the source or the destination is not associated; 'expired'; "
         "'radio off'; 'waiting': in the queue when this was written"},
        {"count", "INTEGER NOT NULL", "", "frames"}},
       "agent, source, destination, verdict"},
      {"relay_queues",
       "queues of the access points for frames to forward, by destination",
       {{"agent", "INTEGER NOT NULL", "", "access point"},
        {"destination", "INTEGER NOT NULL", "", "agent, or everyone"},
        {"frames", "INTEGER NOT NULL", "", "frames accepted by the queue"},
        {"waiting", "INTEGER NOT NULL", "",
         "frames among these that were still queued when this was written"},
        {"most", "INTEGER NOT NULL", "", "largest number that waited at the same time"},
        {"waited_ns", "INTEGER NOT NULL", "ns",
         "sum of their times in the queue: divided by `frames` the mean time in the queue, divided "
         "by the length of the run the mean length of the queue"}},
       "agent, destination"},
  };
}

}  // namespace results::record
