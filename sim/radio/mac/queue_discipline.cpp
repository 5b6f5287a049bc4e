#include "sim/radio/mac/queue_discipline.h"

#include <utility>

#include "sim/radio/mac/fq_codel.h"

namespace sim::radio {

std::unique_ptr<QueueDiscipline> make_discipline(const QueuesConfig& config,
                                                 const QueueLimits& limits, std::uint64_t seed) {
  if (config.discipline == Discipline::kFqCodel) {
    return std::make_unique<FqCodel>(config.fq_codel, limits, seed);
  }
  return std::make_unique<FifoQueue>(limits);
}

void FlowQueue::push(WaitingMsdu msdu) {
  bytes_ += msdu.bytes();
  queue_.push_back(std::move(msdu));
}

std::optional<WaitingMsdu> FlowQueue::pop() {
  if (queue_.empty()) return std::nullopt;
  std::optional<WaitingMsdu> first(std::move(queue_.front()));
  queue_.pop_front();
  bytes_ -= first->bytes();
  return first;
}

void FlowQueue::expire(hal::Time before, DroppedMsdus& dropped) {
  while (!queue_.empty() && queue_.front().since < before) {
    dropped.push_back({std::move(*pop()), hal::Verdict::kExpired});
  }
}

void FifoQueue::push(WaitingMsdu msdu, DroppedMsdus& /*dropped*/) { queue_.push(std::move(msdu)); }

std::optional<WaitingMsdu> FifoQueue::pop(hal::Time /*now*/, DroppedMsdus& /*dropped*/) {
  return queue_.pop();
}

void FifoQueue::expire(hal::Time before, DroppedMsdus& dropped) { queue_.expire(before, dropped); }

}  // namespace sim::radio
