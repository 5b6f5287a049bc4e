#include "sim/radio/mac/msdu_queues.h"

#include <algorithm>
#include <limits>

#include "sim/radio/mac/lifetime.h"

namespace sim::radio {
namespace {

QueueLimits limits_in(const DcfConfig& config) {
  QueueLimits limits{.frames = config.queues.limit.value_or(config.contention.queue_limit)};
  if (config.queues.limit_bytes) limits.bytes = *config.queues.limit_bytes;
  return limits;
}

std::optional<hal::Duration> quantum_in(const QueuesConfig& config) {
  return config.airtime_fairness ? std::optional(config.airtime_quantum) : std::nullopt;
}

}  // namespace

MsduQueues::MsduQueues(const DcfConfig& config, std::size_t functions, const Station& station)
    : config_(config),
      limits_(limits_in(config)),
      station_(station),
      schedules_(functions, StationSchedule(quantum_in(config.queues))),
      counts_(functions) {}

MsduQueues::Queue& MsduQueues::queue(const Name& name) {
  const auto [place, is_new] = queues_.try_emplace(name);
  if (is_new) place->second.discipline = make_discipline(config_.queues, limits_, station_.seed);
  return place->second;
}

void MsduQueues::tell(const Name& name, hal::Time now, const WaitingMsdu& msdu,
                      QueueChange::What what, hal::Verdict verdict) {
  QueueChange change{.station = station_.agent,
                     .receiver = name.receiver,
                     .what = what,
                     .bytes = msdu.bytes(),
                     .verdict = verdict};
  if (config_.qos) change.category = static_cast<AccessCategory>(name.function);
  station_.observer.on_queue(now, change);
}

void MsduQueues::report(const Name& name, hal::Time now, const DroppedMsdus& dropped) {
  counts_[name.function].waiting -= dropped.size();
  for (const DroppedMsdu& one : dropped) {
    tell(name, now, one.waiting, QueueChange::What::kDropped, one.verdict);
    client_->on_dropped(one.waiting, one.verdict);
  }
}

/// All MSDUs of a queue have the same lifetime.
void MsduQueues::expire(const Name& name, Queue& queue, hal::Time now, DroppedMsdus& dropped) {
  const std::optional<hal::Duration> lifetime =
      lifetime_of(config_, static_cast<AccessCategory>(name.function));
  if (lifetime) queue.discipline->expire(now - *lifetime, dropped);
}

bool MsduQueues::push(const Name& name, WaitingMsdu msdu, hal::Time now) {
  Queue& one = queue(name);
  DroppedMsdus dropped;
  expire(name, one, now, dropped);
  const bool is_accepted = one.discipline->accepts(msdu);
  tell(name, now, msdu, is_accepted ? QueueChange::What::kQueued : QueueChange::What::kRefused,
       is_accepted ? hal::Verdict::kDelivered : hal::Verdict::kQueueFull);
  if (is_accepted) {
    ++counts_[name.function].waiting;
    one.discipline->push(std::move(msdu), dropped);
    schedules_[name.function].add(name.receiver);
  }
  report(name, now, dropped);
  return is_accepted;
}

std::optional<WaitingMsdu> MsduQueues::take(const Name& name, Queue& queue, hal::Time now) {
  DroppedMsdus dropped;
  expire(name, queue, now, dropped);
  std::optional<WaitingMsdu> next = queue.discipline->pop(now, dropped);
  report(name, now, dropped);
  if (next) {
    --counts_[name.function].waiting;
    tell(name, now, *next, QueueChange::What::kLeft);
  }
  return next;
}

std::optional<Outgoing> MsduQueues::pop(const Name& name, hal::Time now) {
  Queue& one = queue(name);
  if (!one.back.empty()) {
    std::optional<Outgoing> first(std::move(one.back.front()));
    one.back.pop_front();
    --counts_[name.function].back;
    return first;
  }
  while (std::optional<WaitingMsdu> next = take(name, one, now)) {
    const hal::Time since = next->since;
    if (std::optional<MacRequest> frame = client_->on_turn(std::move(*next))) {
      return Outgoing{.request = std::move(*frame), .queued = since};
    }
  }
  return std::nullopt;
}

void MsduQueues::put_back(const Name& name, Outgoing outgoing) {
  queue(name).back.push_front(std::move(outgoing));
  ++counts_[name.function].back;
}

bool MsduQueues::has(const Name& name) const {
  const auto found = queues_.find(name);
  if (found == queues_.end()) return false;
  return !found->second.back.empty() ||
         (found->second.discipline->frames() > 0 && client_->is_open());
}

std::size_t MsduQueues::waiting() const {
  std::size_t all = 0;
  for (const Count& count : counts_) all += count.waiting;
  return all;
}

std::size_t MsduQueues::waiting_with_back() const {
  std::size_t all = waiting();
  for (const Count& count : counts_) all += count.back;
  return all;
}

std::size_t MsduQueues::room(ContentionFunction function) const {
  std::size_t most = 0;
  for (const auto& [name, one] : queues_) {
    if (name.function == function) most = std::max(most, one.discipline->frames());
  }
  return limits_.frames - std::min(limits_.frames, most);
}

void MsduQueues::clear(hal::Time now, std::vector<Outgoing>& back) {
  for (auto& [name, one] : queues_) {
    DroppedMsdus all;
    one.discipline->expire(hal::Time::max(), all);
    for (DroppedMsdu& msdu : all) msdu.verdict = hal::Verdict::kRadioOff;
    report(name, now, all);
    for (Outgoing& outgoing : one.back) back.push_back(std::move(outgoing));
    one.back.clear();
    counts_[name.function].back = 0;
  }
}

}  // namespace sim::radio
