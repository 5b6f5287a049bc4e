#include "sim/core/event_slots.h"

namespace sim {
namespace {

constexpr std::uint32_t kFirstGeneration = 2;
constexpr std::uint32_t kLastGeneration = ~std::uint32_t{1};

}  // namespace

EventSlots::~EventSlots() {
  for (const auto& block : blocks_) {
    for (std::uint32_t i = 0; i < kBlock; ++i) {
      EventSlot& slot = block[i];
      if (slot.act != nullptr) slot.act(slot.storage, EventSlot::Act::kDestroy);
    }
  }
}

std::uint32_t EventSlots::claim(bool must_destroy) {
  if (free_.empty()) {
    const auto first = static_cast<std::uint32_t>(blocks_.size()) * kBlock;
    blocks_.push_back(std::make_unique<EventSlot[]>(kBlock));
    generations_.resize(generations_.size() + kBlock, kFirstGeneration);
    for (std::uint32_t i = kBlock; i > 0; --i) free_.push_back(first + i - 1);
  }
  const std::uint32_t index = free_.back();
  free_.pop_back();
  if (must_destroy) ++generations_[index];
  return index;
}

void EventSlots::release(std::uint32_t index) {
  // A slot whose generations are used up is not reused: that costs 64 bytes in two thousand million
  // events.
  if (generations_[index] != kLastGeneration) free_.push_back(index);
}

}  // namespace sim
