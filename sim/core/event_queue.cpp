#include "sim/core/event_queue.h"

#include "hal/types/check.h"

namespace sim {
namespace {

constexpr int kCounterBits = 40;
constexpr int kAgentBits = 16;

}  // namespace

EventSlot& EventQueue::claim(Time at, Rank rank, AgentId agent, EventId& id) {
  BARAKA_CHECK(at >= now_);
  const std::uint32_t index = slots_.claim();
  if (agent.value >= counters_.size()) counters_.resize(agent.value + 1u, 0);
  const std::uint64_t counter = counters_[agent.value]++;
  // Rank, agent, counter from high bits to low.
  const std::uint64_t order = (static_cast<std::uint64_t>(rank) << (kAgentBits + kCounterBits)) |
                              (static_cast<std::uint64_t>(agent.value) << kCounterBits) | counter;
  EventSlot& slot = slots_[index];
  slot.time = static_cast<std::uint64_t>(hal::to_ns(at));
  events_.push({slot.time, order, index});
  ++live_;
  id = {index, slot.generation};
  return slot;
}

bool EventQueue::is_pending(EventId id) const {
  if (id.generation == 0) return false;
  const EventSlot& slot = slots_[id.slot];
  return slot.generation == id.generation && slot.act != nullptr;
}

bool EventQueue::cancel(EventId& id) {
  const EventId event = std::exchange(id, {});
  if (!is_pending(event)) return false;
  EventSlot& slot = slots_[event.slot];
  const auto act = std::exchange(slot.act, nullptr);
  act(slot.storage, EventSlot::Act::kDestroy);
  --live_;
  if (events_.remove(slot)) slots_.release(event.slot);  // else when it is next()
  return true;
}

/// The next entry that is not cancelled; null if there is none.
const FutureEvents::Entry* EventQueue::next() {
  const FutureEvents::Entry* entry = events_.front();
  while (entry != nullptr && slots_[entry->slot].act == nullptr) {
    slots_.release(entry->slot);
    events_.pop();
    entry = events_.front();
  }
  return entry;
}

std::optional<Time> EventQueue::next_time() {
  const FutureEvents::Entry* entry = next();
  if (entry == nullptr) return std::nullopt;
  return hal::time_from_ns(static_cast<std::int64_t>(entry->time));
}

void EventQueue::run_next() {
  const FutureEvents::Entry* entry = next();
  BARAKA_CHECK(entry != nullptr);
  now_ = hal::time_from_ns(static_cast<std::int64_t>(entry->time));
  const std::uint32_t index = entry->slot;
  events_.pop();
  ++executed_;
  --live_;
  EventSlot& slot = slots_[index];
  const auto act = std::exchange(slot.act, nullptr);  // not pending any more while it runs
  act(slot.storage, EventSlot::Act::kRunAndDestroy);
  slots_.release(index);
}

void EventQueue::advance_to(Time at) {
  BARAKA_CHECK(at >= now_);
  const auto first = next_time();
  BARAKA_CHECK(!first || *first >= at);
  now_ = at;
}

}  // namespace sim
