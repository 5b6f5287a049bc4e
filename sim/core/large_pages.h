#pragma once

#include <cstddef>

namespace sim {

/// Announces that the heap will grow by about so many bytes, so that they lie in huge pages if the
/// system has them (madvise(2), MADV_HUGEPAGE). A frame touches the memory of hundreds of stations;
/// with pages of 4 KiB the addresses of more than a few thousand of them are not in the
/// processor's table of translations. No effect on results; memory that is never allocated is never
/// taken from the system. Does nothing below 16 MiB, and where another allocator replaces malloc().
/// @return how many bytes of the heap are advised now.
std::size_t expect_allocations(std::size_t bytes);

}  // namespace sim
