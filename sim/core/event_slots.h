#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace sim {

/// Where the handler of one event is kept while it is pending. One cache line.
struct alignas(64) EventSlot {
  static constexpr std::size_t kHandlerSize = 40;
  enum class Act : std::uint8_t { kRunAndDestroy, kDestroy };

  void (*act)(void*, Act) = nullptr;  ///< Null: free, cancelled or running.
  std::uint64_t time = 0;             ///< ns
  std::uint32_t generation = 1;       ///< Counts the events it has been used for.
  std::uint32_t position = 0;         ///< Of its entry in an unsorted list of FutureEvents.
  alignas(alignof(void*)) std::byte storage[kHandlerSize];
};

/// Slots by index. They do not move, so a handler may schedule others while it runs.
class EventSlots {
 public:
  EventSlots() = default;
  ~EventSlots();  ///< Destroys the handlers left.
  EventSlots(const EventSlots&) = delete;
  EventSlots& operator=(const EventSlots&) = delete;

  EventSlot& operator[](std::uint32_t index) { return blocks_[index / kBlock][index % kBlock]; }
  const EventSlot& operator[](std::uint32_t index) const {
    return blocks_[index / kBlock][index % kBlock];
  }

  /// Index of a slot that is free no longer.
  std::uint32_t claim();

  /// Makes a slot free. From now on ids of the event it was used for name none.
  void release(std::uint32_t index);

 private:
  static constexpr std::uint32_t kBlock = 256;

  std::vector<std::unique_ptr<EventSlot[]>> blocks_;
  std::vector<std::uint32_t> free_;  ///< The last one was used last, and is likely to be cached.
};

}  // namespace sim
