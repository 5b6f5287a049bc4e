#include "sim/core/event_slots.h"

namespace sim {

EventSlots::~EventSlots() {
  for (const auto& block : blocks_) {
    for (std::uint32_t i = 0; i < kBlock; ++i) {
      EventSlot& slot = block[i];
      if (slot.act != nullptr) slot.act(slot.storage, EventSlot::Act::kDestroy);
    }
  }
}

std::uint32_t EventSlots::claim() {
  if (free_.empty()) {
    const auto first = static_cast<std::uint32_t>(blocks_.size()) * kBlock;
    blocks_.push_back(std::make_unique<EventSlot[]>(kBlock));
    for (std::uint32_t i = kBlock; i > 0; --i) free_.push_back(first + i - 1);
  }
  const std::uint32_t index = free_.back();
  free_.pop_back();
  return index;
}

void EventSlots::release(std::uint32_t index) {
  EventSlot& slot = (*this)[index];
  slot.act = nullptr;
  if (++slot.generation == 0) slot.generation = 1;
  free_.push_back(index);
}

}  // namespace sim
