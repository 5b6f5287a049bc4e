#include "sim/core/large_pages.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace {

/// The flags of the mapping with this address, as in /proc/self/smaps.
std::string flags_of(const void* address) {
  const auto wanted = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream maps("/proc/self/smaps");
  bool is_it = false;
  for (std::string line; std::getline(maps, line);) {
    std::istringstream range(line);
    std::uintptr_t begin = 0, end = 0;
    char dash = 0;
    if (range >> std::hex >> begin >> dash >> end && dash == '-') {
      is_it = begin <= wanted && wanted < end;
    }
    if (is_it && line.starts_with("VmFlags:")) return line + " ";
  }
  return {};
}

TEST(LargePages, SmallAllocationsThatFollowLieInPagesWhichTheSystemMayMakeHuge) {
  constexpr std::size_t kExpected = std::size_t{64} << 20;
  const std::size_t advised = sim::expect_allocations(kExpected);
  if (advised == 0) GTEST_SKIP() << "another allocator, or a system without huge pages";
  EXPECT_GE(advised, kExpected);

  // The first ones fill gaps, of which there may be some megabytes.
  std::vector<std::vector<char>> pieces;
  for (int i = 0; i < 4000; ++i) pieces.emplace_back(10'000);
  for (std::size_t i = pieces.size() - 100; i < pieces.size(); ++i) {
    EXPECT_NE(flags_of(pieces[i].data()).find(" hg "), std::string::npos) << "piece " << i;
  }
}

TEST(LargePages, FewAllocationsAreLeftAlone) {
  EXPECT_EQ(sim::expect_allocations(std::size_t{1} << 20), 0u);
}

}  // namespace
