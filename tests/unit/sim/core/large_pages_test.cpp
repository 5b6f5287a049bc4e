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

  std::vector<std::vector<char>> pieces;
  for (int i = 0; i < 1000; ++i) pieces.emplace_back(10'000);
  std::size_t huge = 0;
  for (const auto& piece : pieces) {
    huge += flags_of(piece.data()).find(" hg ") != std::string::npos ? 1 : 0;
  }
  EXPECT_GE(huge, 990u);  // the first few may fill gaps
}

TEST(LargePages, FewAllocationsAreLeftAlone) {
  EXPECT_EQ(sim::expect_allocations(std::size_t{1} << 20), 0u);
}

}  // namespace
