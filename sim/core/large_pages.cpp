#include "sim/core/large_pages.h"

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace sim {
namespace {

constexpr std::size_t kWorthwhile = std::size_t{16} << 20;
constexpr std::size_t kMost = std::size_t{1} << 30;
/// glibc's greatest, up to which its own adaptation goes, too (mallopt(3), M_MMAP_THRESHOLD).
constexpr int kOwnMapping = 32 << 20;
/// glibc's M_TOP_PAD.
constexpr int kUsualPad = 128 << 10;
/// Below glibc's first M_MMAP_THRESHOLD, so that it comes from the heap.
constexpr std::size_t kProbe = 100 << 10;
constexpr std::size_t kMostProbes = 256;

/// On the border of two pages, as glibc keeps it.
std::byte* heap_end() { return static_cast<std::byte*>(sbrk(0)); }

/// Makes the heap grow by so many bytes at once, without touching them. @return what is new.
std::span<std::byte> grow_heap(std::size_t bytes) {
  // glibc would give the unused end of the heap back with the next free().
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_MMAP_THRESHOLD, kOwnMapping);
  malloc_trim(0);
  std::byte* const begin = heap_end();
  mallopt(M_TOP_PAD, static_cast<int>(bytes));
  std::vector<std::unique_ptr<char[]>> probes;  // the first ones fill gaps
  while (heap_end() == begin && probes.size() < kMostProbes) {
    probes.push_back(std::make_unique<char[]>(kProbe));
  }
  probes.clear();
  mallopt(M_TOP_PAD, kUsualPad);
  std::byte* const end = heap_end();
  return end > begin ? std::span(begin, end) : std::span<std::byte>();
}

}  // namespace

std::size_t expect_allocations(std::size_t bytes) {
  if (bytes < kWorthwhile) return 0;
  // An earlier call has left so much unused at the heap's end.
  if (mallinfo2().keepcost >= bytes) return bytes;
  const std::span<std::byte> grown = grow_heap(std::min(bytes, kMost));
  return madvise(grown.data(), grown.size(), MADV_HUGEPAGE) == 0 ? grown.size() : 0;
}

}  // namespace sim
