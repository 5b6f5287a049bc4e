#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace sim {

/// Storage for the handler of one pending event. One cache line.
struct alignas(64) EventSlot {
  static constexpr std::size_t kHandlerSize = 48;
  enum class Act : std::uint8_t { kRunAndDestroy, kDestroy };

  void (*act)(void*, Act) = nullptr;  ///< Runs or destroys the handler; null once destroyed.
  alignas(alignof(void*)) std::byte storage[kHandlerSize];
};

/// Slots by index. They do not move, so a handler may schedule others while it runs. A slot is
/// reused for one event after another; a generation number distinguishes them. Generations are
/// stored in an array of their own: detecting a cancelled event is then far cheaper than accessing
/// its former slot.
class EventSlots {
 public:
  EventSlots() = default;
  ~EventSlots();  ///< Destroys the handlers that remain.
  EventSlots(const EventSlots&) = delete;
  EventSlots& operator=(const EventSlots&) = delete;

  EventSlot& operator[](std::uint32_t index) { return blocks_[index / kBlock][index % kBlock]; }
  const EventSlot& operator[](std::uint32_t index) const {
    return blocks_[index / kBlock][index % kBlock];
  }

  /// Differs between successive events of a slot, and is never 0. Odd if the event's handler must
  /// be destroyed; handlers of other events can simply be forgotten.
  std::uint32_t generation(std::uint32_t index) const { return generations_[index]; }
  static bool must_destroy(std::uint32_t generation) { return generation % 2 != 0; }

  /// Takes a free slot. @return its index.
  std::uint32_t claim(bool must_destroy);

  /// Gives the slot another generation. It does not become free before release().
  void end_generation(std::uint32_t index) { generations_[index] = (generations_[index] | 1) + 1; }

  /// Makes a slot free. @pre its generation was ended.
  void release(std::uint32_t index);

 private:
  static constexpr std::uint32_t kBlock = 256;
  static constexpr std::uint32_t kLastGeneration = ~std::uint32_t{1};

  void grow();

  std::vector<std::unique_ptr<EventSlot[]>> blocks_;
  std::vector<std::uint32_t> generations_;
  /// Used as a stack: the slot freed last is likely to be in the cache.
  std::vector<std::uint32_t> free_;
};

// Called for every event; what hardly ever happens is elsewhere.
inline std::uint32_t EventSlots::claim(bool must_destroy) {
  if (free_.empty()) [[unlikely]]
    grow();
  const std::uint32_t index = free_.back();
  free_.pop_back();
  if (must_destroy) ++generations_[index];
  return index;
}

inline void EventSlots::release(std::uint32_t index) {
  // A slot whose generations are used up is not reused: that costs 64 bytes in two thousand million
  // events.
  if (generations_[index] != kLastGeneration) free_.push_back(index);
}

}  // namespace sim
