#pragma once

#include <sys/select.h>

#include <cstddef>
#include <cstring>

namespace programs::preload {

/// The sets of select(), which it overwrites. Null: none.
struct DescriptorSets {
  fd_set *readable = nullptr, *writable = nullptr, *exceptional = nullptr;
};

/// What a program has asked for of one of them. Its set may be shorter than an fd_set: it is as
/// long as the descriptors that it asks for need.
class AskedSet {
 public:
  AskedSet(const fd_set* set, int count)
      : size_(set == nullptr
                  ? 0
                  : static_cast<std::size_t>((count + NFDBITS - 1) / NFDBITS) * sizeof(fd_mask)) {
    if (set != nullptr) std::memcpy(&kept_, set, size_);
  }
  void restore(fd_set* set) const {
    if (set != nullptr) std::memcpy(set, &kept_, size_);
  }
  void clear(fd_set* set) const {
    if (set != nullptr) std::memset(set, 0, size_);
  }

 private:
  fd_set kept_{};
  std::size_t size_;
};

/// Of all three.
class AskedSets {
 public:
  AskedSets(const DescriptorSets& sets, int count)
      : readable_(sets.readable, count),
        writable_(sets.writable, count),
        exceptional_(sets.exceptional, count) {}

  void restore(const DescriptorSets& sets) const {
    readable_.restore(sets.readable);
    writable_.restore(sets.writable);
    exceptional_.restore(sets.exceptional);
  }
  void clear(const DescriptorSets& sets) const {
    readable_.clear(sets.readable);
    writable_.clear(sets.writable);
    exceptional_.clear(sets.exceptional);
  }

 private:
  AskedSet readable_, writable_, exceptional_;
};

}  // namespace programs::preload
