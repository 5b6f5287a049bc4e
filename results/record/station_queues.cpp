#include "results/record/station_queues.h"

#include <algorithm>

namespace results::record {
namespace {

std::string_view category_of(const sim::radio::QueueChange& change) {
  return change.category ? sim::radio::name(*change.category) : "all";
}

}  // namespace

StationQueues::StationQueues(Database& database)
    : put_queue_(database, "REPLACE INTO station_queues VALUES (?, ?, ?, ?, ?, ?, ?, ?)"),
      put_drops_(database, "REPLACE INTO station_queue_drops VALUES (?, ?, ?, ?, ?)") {}

void StationQueues::on_queue(hal::Time at, const sim::radio::QueueChange& change) {
  using What = sim::radio::QueueChange::What;
  changed_ = true;
  Queue& queue = queues_[{change.station, change.receiver, category_of(change)}];
  // What is dropped to make room for a frame follows that frame.
  if (change.what != What::kDropped || at > queue.since) queue.settle();
  queue.wait_until(at);
  if (change.what == What::kDropped || change.what == What::kRefused) {
    ++queue.dropped[static_cast<std::size_t>(change.verdict)];
  }
  if (change.what == What::kRefused) return;
  if (change.what == What::kQueued) {
    ++queue.frames;
    ++queue.waiting;
    queue.bytes += change.bytes;
    return;
  }
  --queue.waiting;
  queue.bytes -= change.bytes;
}

void StationQueues::write(hal::Time now) {
  if (!changed_) return;
  changed_ = false;
  for (auto& [key, queue] : queues_) {
    const auto& [agent, receiver, category] = key;
    // While frames wait, the row changes with time: write it again next time.
    changed_ = changed_ || queue.waiting > 0;
    queue.settle();
    queue.wait_until(std::max(now, queue.since));
    put_queue_.run(agent.value, receiver.value, category, queue.frames, queue.waiting, queue.most,
                   queue.most_bytes, queue.waited.count());
    for (std::size_t i = 0; i < queue.dropped.size(); ++i) {
      if (queue.dropped[i] == 0) continue;
      put_drops_.run(agent.value, receiver.value, category, hal::name(static_cast<hal::Verdict>(i)),
                     queue.dropped[i]);
    }
  }
}

std::vector<Table> StationQueues::tables() {
  const Column agent{"agent", "INTEGER NOT NULL", "", "where they waited"};
  const Column receiver{"receiver", "INTEGER NOT NULL", "",
                        "next receiver; everyone: group frames or, of an agent that sends through "
                        "an access point, all"};
  const Column category{"category", "TEXT NOT NULL", "",
                        "access category: 'BK', 'BE', 'VI' or 'VO'; 'all': of an agent without "
                        "QoS"};
  return {
      {"station_queues",
       "queues of agents with a queue for each receiver and access category (`queues.per: station` "
       "of the radio)",
       {agent,
        receiver,
        category,
        {"frames", "INTEGER NOT NULL", "", "data frames accepted by the queue"},
        {"waiting", "INTEGER NOT NULL", "",
         "frames among these that were still queued when this was written"},
        {"most", "INTEGER NOT NULL", "", "largest number that waited at the same time"},
        {"most_bytes", "INTEGER NOT NULL", "byte", "largest payload that waited at the same time"},
        {"waited_ns", "INTEGER NOT NULL", "ns",
         "sum of their times in the queue, up to when they were about to be sent"}},
       "agent, receiver, category"},
      {"station_queue_drops",
       "data frames that these queues refused or dropped",
       {agent,
        receiver,
        category,
        {"verdict", "TEXT NOT NULL", "",
         "'queue full': refused or, with fq_codel, dropped to make room; 'queue delay': dropped by "
         "CoDel; 'expired'; 'radio off'"},
        {"count", "INTEGER NOT NULL", "", "frames"}},
       "agent, receiver, category, verdict"},
  };
}

}  // namespace results::record
