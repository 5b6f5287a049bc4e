#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/core/event_slots.h"

namespace sim {

/// Entries in order of (time, order). Near ones are in a heap; later ones unsorted in buckets of
/// equal width, of which the next becomes the heap when that is empty; still later ones unsorted
/// in one list, which is spread over new buckets when the last is used up. So the heap stays small
/// however many events are pending: pushing and popping takes constant time. After: Tang, Goh and
/// Thng, "Ladder queue: an O(1) priority queue structure for large-scale discrete event
/// simulation", 2005, with one rung.
class FutureEvents {
 public:
  struct Entry {
    std::uint64_t time;   ///< ns
    std::uint64_t order;  ///< Among entries of one time.
    std::uint32_t slot;
    bool before(const Entry& other) const { return key() < other.key(); }

   private:
    __extension__ using Key = unsigned __int128;
    Key key() const { return (static_cast<Key>(time) << 64) | order; }
  };

  /// @param slots  those that entries name; their positions are kept up to date.
  explicit FutureEvents(EventSlots& slots) : slots_(slots) {}

  void push(const Entry& entry);

  /// Takes out the entry of a slot unless it is near: then it stays until it is at the front.
  /// @return whether it was taken out.
  bool remove(const EventSlot& slot);

  /// The first entry; null if there is none.
  const Entry* front();

  /// Takes out the first entry. @pre front() was not null.
  void pop();

 private:
  std::vector<Entry>& list_of(std::uint64_t time);
  void append(const Entry& entry);
  bool refill();
  void spread();
  void spill();
  void push_near(const Entry& entry);
  void take_near(std::vector<Entry>& list);

  EventSlots& slots_;
  std::vector<Entry> near_;      ///< 4-ary heap of those before near_end_.
  std::uint64_t near_end_ = 0;   ///< ns
  std::size_t spill_at_ = 1024;  ///< Size of the heap.
  std::vector<std::vector<Entry>> buckets_;
  std::size_t next_bucket_ = 0, bucket_count_ = 0;  ///< Of those in use.
  std::uint64_t buckets_begin_ = 0;                 ///< ns
  int bucket_shift_ = 0;                            ///< Width: 2^shift ns.
  std::vector<Entry> far_;
  std::vector<Entry> moving_;  ///< Empty but while entries are spread or spilled.
};

}  // namespace sim
