#include "sim/radio/mac/codel.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace sim::radio {
namespace {

/// A queue that has no more than one packet of the interface's MTU is never dropped from (RFC 8289,
/// 5.3); Linux gives wireless interfaces that of Ethernet.
constexpr std::size_t kMtu = 1500;
/// Dropping that begins again within so many intervals goes on at the earlier rate (5.5).
constexpr int kRecently = 16;

}  // namespace

/// The control law (RFC 8289, 5.4).
hal::Time Codel::next_drop(hal::Time after) const {
  const double interval = static_cast<double>(config_.interval.count());
  return after + hal::Duration{static_cast<std::int64_t>(interval / std::sqrt(count_))};
}

Codel::Popped Codel::pop_one(FlowQueue& queue, hal::Time now) {
  Popped popped{queue.pop()};
  if (!popped.msdu || now - popped.msdu->since < config_.target || queue.bytes() <= kMtu) {
    above_until_.reset();
  } else if (!above_until_) {
    above_until_ = now + config_.interval;
  } else {
    popped.may_drop = now >= *above_until_;
  }
  return popped;
}

std::optional<WaitingMsdu> Codel::pop(FlowQueue& queue, hal::Time now, DroppedMsdus& dropped) {
  Popped popped = pop_one(queue, now);
  if (is_dropping_) {
    go_on(popped, queue, now, dropped);
  } else if (popped.may_drop) {
    begin(popped, queue, now, dropped);
  }
  return std::move(popped.msdu);
}

void Codel::go_on(Popped& popped, FlowQueue& queue, hal::Time now, DroppedMsdus& dropped) {
  is_dropping_ = popped.may_drop;
  while (is_dropping_ && now >= drop_next_) {
    dropped.push_back({std::move(*popped.msdu), hal::Verdict::kQueueDelay});
    ++count_;
    popped = pop_one(queue, now);
    is_dropping_ = popped.may_drop;
    if (is_dropping_) drop_next_ = next_drop(drop_next_);
  }
}

void Codel::begin(Popped& popped, FlowQueue& queue, hal::Time now, DroppedMsdus& dropped) {
  dropped.push_back({std::move(*popped.msdu), hal::Verdict::kQueueDelay});
  popped = pop_one(queue, now);
  is_dropping_ = true;
  const std::uint32_t since_then = count_ - last_count_;
  const bool is_recent = now - drop_next_ < kRecently * config_.interval;
  count_ = since_then > 1 && is_recent ? since_then : 1;
  drop_next_ = next_drop(now);
  last_count_ = count_;
}

}  // namespace sim::radio
