#include "sim/core/event_queue.h"

#include "hal/types/check.h"

namespace sim {

/// @param agent  the first event of this one.
void EventQueue::add_counters(AgentId agent) { counters_.resize(agent.value + 1u, 0); }

EventSlot& EventQueue::claim(Time at, Place place, bool must_destroy, EventId& id) {
  BARAKA_CHECK(at >= now_);
  const std::uint32_t index = slots_.claim(must_destroy);
  id = {index, slots_.generation(index)};
  events_.push({static_cast<std::uint64_t>(hal::to_ns(at)), place.order, id.slot, id.generation});
  return slots_[index];
}

bool EventQueue::go_on(Time at, Place place) {
  if (at > last_) return false;
  BARAKA_CHECK(at >= now_);
  const FutureEvents::Entry* const first = events_.front();
  const FutureEvents::Entry next{static_cast<std::uint64_t>(hal::to_ns(at)), place.order, 0, 0};
  if (first != nullptr && first->before(next)) return false;
  now_ = at;
  ++executed_;
  return true;
}

bool EventQueue::is_pending(EventId id) const {
  return id.generation != 0 && slots_.generation(id.slot) == id.generation;
}

/// Of an id that names an event, which may be over.
bool EventQueue::cancel_known(EventId& id) {
  const EventId event = std::exchange(id, {});
  if (!is_pending(event)) return false;
  slots_.end_generation(event.slot);
  __builtin_prefetch(&slots_[event.slot], 1);  // the next event will use this slot
  if (EventSlots::must_destroy(event.generation)) {
    EventSlot& slot = slots_[event.slot];
    const auto act = std::exchange(slot.act, nullptr);
    act(slot.storage, EventSlot::Act::kDestroy);
  }
  slots_.release(event.slot);
  events_.note_cancelled();
  return true;
}

std::optional<Time> EventQueue::next_time() {
  const FutureEvents::Entry* entry = events_.front();
  if (entry == nullptr) return std::nullopt;
  return hal::time_from_ns(static_cast<std::int64_t>(entry->time));
}

void EventQueue::run_next(Time last) {
  const FutureEvents::Entry* entry = events_.front();
  BARAKA_CHECK(entry != nullptr);
  now_ = hal::time_from_ns(static_cast<std::int64_t>(entry->time));
  last_ = last;
  const std::uint32_t index = entry->slot;
  events_.pop();
  ++executed_;
  slots_.end_generation(index);  // a running event is no longer pending
  EventSlot& slot = slots_[index];
  const auto act = std::exchange(slot.act, nullptr);
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
