#include "sim/core/future_events.h"

#include <algorithm>
#include <array>
#include <bit>

namespace sim {
namespace {

using Entry = FutureEvents::Entry;

constexpr std::size_t kArity = 4;
constexpr std::size_t kPerBucket = 16;    // keeps the heap within two levels
constexpr std::size_t kLargeHeap = 1024;  // 24 KiB: what the first cache can hold

/// A time that about three quarters of the entries are not after, from a sample. A few in the far
/// future do not make the buckets too wide, and most leave the list each time.
std::uint64_t upper_quartile(const std::vector<Entry>& entries) {
  std::array<std::uint64_t, 64> sample{};
  const std::size_t size = std::min(sample.size(), entries.size());
  for (std::size_t i = 0; i < size; ++i) sample[i] = entries[i * entries.size() / size].time;
  const auto end = sample.begin() + static_cast<std::ptrdiff_t>(size);
  const auto quartile = sample.begin() + static_cast<std::ptrdiff_t>(size * 3 / 4);
  std::nth_element(sample.begin(), quartile, end);
  return *quartile;
}

std::uint64_t least_time(const std::vector<Entry>& entries) {
  std::uint64_t least = entries.front().time;
  for (const Entry& entry : entries) least = std::min(least, entry.time);
  return least;
}

}  // namespace

void FutureEvents::push(const Entry& entry) {
  if (entry.time >= near_end_) return append(entry);
  push_near(entry);
  if (near_.size() > spill_at_ && next_bucket_ == bucket_count_) spill();
}

std::vector<Entry>& FutureEvents::list_of(std::uint64_t time) {
  const std::uint64_t bucket = (time - buckets_begin_) >> bucket_shift_;
  return bucket < bucket_count_ ? buckets_[bucket] : far_;
}

void FutureEvents::append(const Entry& entry) {
  std::vector<Entry>& list = list_of(entry.time);
  slots_[entry.slot].position = static_cast<std::uint32_t>(list.size());
  list.push_back(entry);
}

bool FutureEvents::remove(const EventSlot& slot) {
  if (slot.time < near_end_) return false;
  std::vector<Entry>& list = list_of(slot.time);
  const std::uint32_t position = slot.position;
  list[position] = list.back();
  slots_[list[position].slot].position = position;
  list.pop_back();
  return true;
}

const Entry* FutureEvents::front() {
  while (near_.empty()) {
    if (!refill()) return nullptr;
  }
  return &near_.front();
}

/// Takes the next bucket, or else makes some. @return false if there is nothing.
bool FutureEvents::refill() {
  if (next_bucket_ == bucket_count_) {
    if (far_.empty()) return false;
    spread();
  }
  std::vector<Entry>& bucket = buckets_[next_bucket_++];
  near_end_ = buckets_begin_ + (next_bucket_ << bucket_shift_);
  take_near(bucket);
  return true;
}

void FutureEvents::take_near(std::vector<Entry>& list) {
  for (const Entry& entry : list) {
    __builtin_prefetch(&slots_[entry.slot]);  // its handler runs soon
    push_near(entry);
  }
  list.clear();
  spill_at_ = std::max(kLargeHeap, 2 * near_.size());
}

/// From the far list to new buckets.
void FutureEvents::spread() {
  buckets_begin_ = least_time(far_);
  const std::uint64_t span = upper_quartile(far_) - buckets_begin_;
  const std::uint64_t least_width = span / std::max<std::size_t>(1, far_.size() / kPerBucket);
  bucket_shift_ = static_cast<int>(std::bit_width(least_width));
  bucket_count_ = (span >> bucket_shift_) + 1;
  next_bucket_ = 0;
  if (buckets_.size() < bucket_count_) buckets_.resize(bucket_count_);
  moving_.swap(far_);
  for (const Entry& entry : moving_) append(entry);
  moving_.clear();
}

/// If what was near reaches too far into the future, it does so no longer.
void FutureEvents::spill() {
  near_end_ = upper_quartile(near_) + 1;
  bucket_count_ = next_bucket_ = 0;
  moving_.swap(near_);
  for (const Entry& entry : moving_) entry.time < near_end_ ? push_near(entry) : append(entry);
  moving_.clear();
  spill_at_ = std::max(kLargeHeap, 2 * near_.size());
}

void FutureEvents::push_near(const Entry& entry) {
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
  const Entry last = near_.back();
  near_.pop_back();
  const std::size_t size = near_.size();
  if (size == 0) return;
  std::size_t i = 0;
  while (true) {
    const std::size_t first = i * kArity + 1;
    if (first >= size) break;
    std::size_t smallest = first;
    const std::size_t end = std::min(first + kArity, size);
    for (std::size_t c = first + 1; c < end; ++c) {
      if (near_[c].before(near_[smallest])) smallest = c;
    }
    if (!near_[smallest].before(last)) break;
    near_[i] = near_[smallest];
    i = smallest;
  }
  near_[i] = last;
}

}  // namespace sim
