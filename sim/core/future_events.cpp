#include "sim/core/future_events.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace sim {
namespace {

using Entry = FutureEvents::Entry;

constexpr std::size_t kArity = 4;
// A heap of three levels, and few enough buckets to stay in the cache.
constexpr std::size_t kPerBucket = 48;
constexpr std::size_t kLargeHeap = 1024;  // 24 KiB, which fits into the level-1 cache
constexpr std::size_t kLeastSample = 12;  // of 64: entries are moved about five times at most
constexpr std::uint64_t kDenser = 8;
// Keeping more lists would in time make every small list large.
constexpr std::size_t kMostSpare = 16;
constexpr std::size_t kLeastSwept = 1024;

/// A time before which most entries lie, estimated from a sample. "Most" is three quarters, so that
/// a few entries in the far future do not widen the buckets much and most entries leave the list
/// each time; fewer if those are much denser, as with timeouts beside the events that they guard.
std::uint64_t horizon(const std::vector<Entry>& entries) {
  std::array<std::uint64_t, 64> sample{};
  const std::size_t size = std::min(sample.size(), entries.size());
  for (std::size_t i = 0; i < size; ++i) sample[i] = entries[i * entries.size() / size].time;
  std::sort(sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(size));
  const auto span = [&sample](std::size_t last) { return sample[last] - sample[0]; };
  std::size_t last = size * 3 / 4;
  while (last > kLeastSample && span(last) / kDenser > span(last / 2)) last /= 2;
  return sample[last];
}

std::uint64_t least_time(const std::vector<Entry>& entries) {
  std::uint64_t least = entries.front().time;
  for (const Entry& entry : entries) least = std::min(least, entry.time);
  return least;
}

/// Of a heap, the child with the earliest entry. @pre the parent has a child.
std::size_t least_child(const std::vector<Entry>& heap, std::size_t parent) {
  const std::size_t first = parent * kArity + 1;
  const std::size_t end = std::min(first + kArity, heap.size());
  std::size_t least = first;
  for (std::size_t c = first + 1; c < end; ++c) {
    if (heap[c].before(heap[least])) least = c;
  }
  return least;
}

}  // namespace

void FutureEvents::push(const Entry& entry) {
  ++entries_;
  if (entry.time >= near_end_) return append(entry);
  push_near(entry);
  if (near_.size() > spill_at_ && next_bucket_ == bucket_count_) spill();
}

void FutureEvents::append(const Entry& entry) {
  const std::uint64_t number = (entry.time - buckets_begin_) >> bucket_shift_;
  if (number >= bucket_count_) return far_.push_back(entry);
  std::vector<Entry>& bucket = buckets_[number];
  if (bucket.capacity() == 0 && !spare_.empty()) {
    bucket = std::move(spare_.back());
    spare_.pop_back();
  }
  bucket.push_back(entry);
}

void FutureEvents::note_cancelled() {
  ++cancelled_;
  // Compared with the number of entries that a sweep visits, so that its cost per cancelled entry
  // is bounded by a constant.
  if (cancelled_ > kLeastSwept + size() + (bucket_count_ - next_bucket_)) sweep();
}

void FutureEvents::sweep() {
  drop_cancelled(near_);
  moving_.swap(near_);
  for (const Entry& entry : moving_) push_near(entry);
  moving_.clear();
  for (std::size_t i = next_bucket_; i < bucket_count_; ++i) drop_cancelled(buckets_[i]);
  drop_cancelled(far_);
}

void FutureEvents::drop_cancelled(std::vector<Entry>& list) {
  std::size_t kept = 0;
  for (const Entry& entry : list) {  // no branch: which entries are cancelled cannot be predicted
    const bool live = is_live(entry);
    list[kept] = entry;
    kept += live ? 1 : 0;
  }
  entries_ -= list.size() - kept;
  cancelled_ -= list.size() - kept;
  list.resize(kept);
}

/// The first entry, after those that were cancelled are dropped and the heap is refilled.
const Entry* FutureEvents::next_front() {
  while (true) {
    while (near_.empty()) {
      if (!refill()) return nullptr;
    }
    if (is_live(near_.front())) return &near_.front();
    pop_near();
    --entries_;
    --cancelled_;
  }
}

/// Makes the next bucket the heap; if none is left, distributes the far list first. @return false
/// if there are no entries.
bool FutureEvents::refill() {
  if (next_bucket_ == bucket_count_) {
    if (cancelled_ > 0) drop_cancelled(far_);
    if (far_.empty()) return false;
    spread();
  }
  std::vector<Entry>& bucket = buckets_[next_bucket_++];
  near_end_ = buckets_begin_ + (next_bucket_ << bucket_shift_);
  take_near(bucket);
  return true;
}

void FutureEvents::take_near(std::vector<Entry>& list) {
  if (cancelled_ > 0) drop_cancelled(list);
  for (const Entry& entry : list) {
    __builtin_prefetch(&slots_[entry.slot]);  // its handler runs soon
    push_near(entry);
  }
  // The memory of this list serves the next buckets, so memory grows with the number of entries and
  // not with the largest size of every bucket.
  list.clear();
  std::vector<Entry> spare;
  spare.swap(list);
  if (spare_.size() < kMostSpare) spare_.push_back(std::move(spare));
  spill_at_ = std::max(kLargeHeap, 2 * near_.size());
}

/// Distributes the far list to new buckets.
void FutureEvents::spread() {
  buckets_begin_ = least_time(far_);
  const std::uint64_t span = horizon(far_) - buckets_begin_;
  const std::uint64_t least_width = span / std::max<std::size_t>(1, far_.size() / kPerBucket);
  bucket_shift_ = static_cast<int>(std::bit_width(least_width));
  bucket_count_ = (span >> bucket_shift_) + 1;
  next_bucket_ = 0;
  if (buckets_.size() < bucket_count_) buckets_.resize(bucket_count_);
  moving_.swap(far_);
  for (const Entry& entry : moving_) append(entry);
  moving_.clear();
}

/// Shortens the span of the heap when it holds too many entries: moves the later ones to the far
/// list.
void FutureEvents::spill() {
  near_end_ = horizon(near_) + 1;
  bucket_count_ = next_bucket_ = 0;
  moving_.swap(near_);
  for (const Entry& entry : moving_) entry.time < near_end_ ? push_near(entry) : append(entry);
  moving_.clear();
  spill_at_ = std::max(kLargeHeap, 2 * near_.size());
}

/// With all that it calls in line, for a call costs as much as the rest.
[[gnu::flatten]] void FutureEvents::push_near(const Entry& entry) {
  std::size_t i = near_.size();
  near_.push_back(entry);
  while (i > 0) {
    const std::size_t parent = (i - 1) / kArity;
    if (!entry.before(near_[parent])) break;
    near_[i] = near_[parent];
    i = parent;
  }
  near_[i] = entry;
}

void FutureEvents::pop() {
  pop_near();
  --entries_;
}

void FutureEvents::pop_near() {
  const Entry last = near_.back();
  near_.pop_back();
  const std::size_t size = near_.size();
  if (size == 0) return;
  std::size_t i = 0;
  while (i * kArity + 1 < size) {
    const std::size_t least = least_child(near_, i);
    if (!near_[least].before(last)) break;
    near_[i] = near_[least];
    i = least;
  }
  near_[i] = last;
}

}  // namespace sim
