#include "sim/core/event_slots.h"

namespace sim {
namespace {

constexpr std::uint32_t kFirstGeneration = 2;

}  // namespace

EventSlots::~EventSlots() {
  for (const auto& block : blocks_) {
    for (std::uint32_t i = 0; i < kBlock; ++i) {
      EventSlot& slot = block[i];
      if (slot.act != nullptr) slot.act(slot.storage, EventSlot::Act::kDestroy);
    }
  }
}

/// More free slots.
void EventSlots::grow() {
  const auto first = static_cast<std::uint32_t>(blocks_.size()) * kBlock;
  blocks_.push_back(std::make_unique<EventSlot[]>(kBlock));
  generations_.resize(generations_.size() + kBlock, kFirstGeneration);
  for (std::uint32_t i = kBlock; i > 0; --i) free_.push_back(first + i - 1);
}

}  // namespace sim
