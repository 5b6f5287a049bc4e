#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/core/event_slots.h"

namespace sim {

/// Entries in the order (time, order). Near entries are in a heap; later ones unsorted in buckets
/// of equal width, of which the next becomes the heap when the heap is empty; still later ones
/// unsorted in one list, which is distributed to new buckets when the last bucket is used up. The
/// heap therefore stays small with any number of pending events: push and pop take constant time.
/// After W. T. Tang, R. S. M. Goh, I. L.-J. Thng, "Ladder queue: an O(1) priority queue structure
/// for large-scale discrete event simulation", 2005, with one rung.
///
/// A cancelled entry stays in place, because searching for it would dominate all other costs.
/// Cancelled entries are dropped when they are moved, and all at once when they outnumber the
/// others. Cancelling therefore takes constant time, too, and at most doubles the memory.
class FutureEvents {
 public:
  struct Entry {
    std::uint64_t time;   ///< ns
    std::uint64_t order;  ///< Order among the entries of one time.
    std::uint32_t slot;
    /// Generation of the slot; differs from the slot's if the event was cancelled.
    std::uint32_t generation;
    bool before(const Entry& other) const { return key() < other.key(); }

   private:
    __extension__ using Key = unsigned __int128;
    Key key() const { return (static_cast<Key>(time) << 64) | order; }
  };

  /// @param slots  the slots to which entries refer.
  explicit FutureEvents(const EventSlots& slots) : slots_(slots) {}

  void push(const Entry& entry);

  /// Call when the generation of an entry's slot has ended before the entry was popped.
  void note_cancelled();

  /// The first entry; null if there is none.
  const Entry* front();

  /// Takes out the first entry. @pre front() was not null.
  void pop();

  /// Number of entries that are not cancelled.
  std::size_t size() const { return entries_ - cancelled_; }

 private:
  bool is_live(const Entry& entry) const {
    return slots_.generation(entry.slot) == entry.generation;
  }
  const Entry* next_front();
  void append(const Entry& entry);
  bool refill();
  void spread();
  void spill();
  void push_near(const Entry& entry);
  void pop_near();
  void take_near(std::vector<Entry>& list);
  void drop_cancelled(std::vector<Entry>& list);
  void sweep();

  const EventSlots& slots_;
  std::size_t entries_ = 0, cancelled_ = 0;  ///< `entries_` includes the cancelled ones.
  std::vector<Entry> near_;                  ///< 4-ary heap of the entries before near_end_.
  std::uint64_t near_end_ = 0;               ///< ns
  std::size_t spill_at_ = 1024;              ///< Size above which the heap is spilled.
  std::vector<std::vector<Entry>> buckets_;
  std::vector<std::vector<Entry>> spare_;           ///< Empty lists with memory, for buckets.
  std::size_t next_bucket_ = 0, bucket_count_ = 0;  ///< The next bucket and the number in use.
  std::uint64_t buckets_begin_ = 0;                 ///< ns
  int bucket_shift_ = 0;                            ///< Width: 2^shift ns.
  std::vector<Entry> far_;
  std::vector<Entry> moving_;  ///< Empty except while entries are distributed or spilled.
};

inline const FutureEvents::Entry* FutureEvents::front() {
  if (!near_.empty() && is_live(near_.front())) [[likely]]
    return &near_.front();
  return next_front();
}

}  // namespace sim
