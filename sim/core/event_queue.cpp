#include "sim/core/event_queue.h"

#include <algorithm>

#include "hal/types/check.h"

namespace sim {
namespace {

constexpr std::size_t kArity = 4;
constexpr int kCounterBits = 40;
constexpr int kAgentBits = 16;

}  // namespace

EventQueue::~EventQueue() {
  for (Slot* slot : slots_) {
    if (slot->run != nullptr) slot->destroy(slot->storage);
    delete slot;
  }
}

EventQueue::Slot& EventQueue::claim(Time at, Rank rank, AgentId agent, EventId& id) {
  BARAKA_CHECK(at >= now_);
  if (free_.empty()) {
    free_.push_back(static_cast<std::uint32_t>(slots_.size()));
    slots_.push_back(new Slot);
  }
  const std::uint32_t index = free_.back();
  free_.pop_back();
  if (agent.value >= counters_.size()) counters_.resize(agent.value + 1u, 0);
  const std::uint64_t counter = counters_[agent.value]++;
  const std::uint64_t order = (static_cast<std::uint64_t>(rank) << (kAgentBits + kCounterBits)) |
                              (static_cast<std::uint64_t>(agent.value) << kCounterBits) | counter;
  push({hal::to_ns(at), order, index});
  ++live_;
  Slot& slot = *slots_[index];
  id = {index, slot.generation};
  return slot;
}

void EventQueue::release(Slot& slot, std::uint32_t index) {
  slot.run = nullptr;
  if (++slot.generation == 0) slot.generation = 1;
  free_.push_back(index);
}

bool EventQueue::is_pending(EventId id) const {
  return id.generation != 0 && slots_[id.slot]->generation == id.generation &&
         slots_[id.slot]->run != nullptr;
}

bool EventQueue::cancel(EventId& id) {
  const EventId event = std::exchange(id, {});
  if (!is_pending(event)) return false;
  Slot& slot = *slots_[event.slot];
  slot.destroy(slot.storage);
  slot.run = nullptr;  // its entry leaves the heap, and the slot is freed, when its time comes
  --live_;
  return true;
}

void EventQueue::drop_cancelled() {
  while (!heap_.empty()) {
    const std::uint32_t index = heap_.front().slot;
    if (slots_[index]->run != nullptr) return;
    pop();
    release(*slots_[index], index);
  }
}

std::optional<Time> EventQueue::next_time() {
  drop_cancelled();
  if (heap_.empty()) return std::nullopt;
  return hal::time_from_ns(heap_.front().time);
}

void EventQueue::run_next() {
  drop_cancelled();
  BARAKA_CHECK(!heap_.empty());
  const Entry next = heap_.front();
  pop();
  now_ = hal::time_from_ns(next.time);
  ++executed_;
  --live_;
  Slot& slot = *slots_[next.slot];
  const auto run = std::exchange(slot.run, nullptr);  // not pending any more while it runs
  run(slot.storage);
  slot.destroy(slot.storage);
  release(slot, next.slot);
}

void EventQueue::advance_to(Time at) {
  BARAKA_CHECK(at >= now_);
  const auto next = next_time();
  BARAKA_CHECK(!next || *next >= at);
  now_ = at;
}

void EventQueue::push(Entry entry) {
  std::size_t i = heap_.size();
  heap_.push_back(entry);
  while (i > 0) {
    const std::size_t parent = (i - 1) / kArity;
    if (!entry.before(heap_[parent])) break;
    heap_[i] = heap_[parent];
    i = parent;
  }
  heap_[i] = entry;
}

void EventQueue::pop() {
  const Entry last = heap_.back();
  heap_.pop_back();
  const std::size_t size = heap_.size();
  if (size == 0) return;
  std::size_t i = 0;
  while (true) {
    const std::size_t first = i * kArity + 1;
    if (first >= size) break;
    std::size_t smallest = first;
    const std::size_t end = std::min(first + kArity, size);
    for (std::size_t c = first + 1; c < end; ++c) {
      if (heap_[c].before(heap_[smallest])) smallest = c;
    }
    if (!heap_[smallest].before(last)) break;
    heap_[i] = heap_[smallest];
    i = smallest;
  }
  heap_[i] = last;
}

}  // namespace sim
