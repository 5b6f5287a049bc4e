#pragma once

#include <cstddef>
#include <vector>

namespace hal {

constexpr std::size_t kCacheLine = 64;  ///< Bytes.

/// Asks for the lines of memory in which these bytes are; returns before they are there.
inline void prefetch(const void* from, std::size_t bytes) {
  const auto* const first = static_cast<const char*>(from);
#pragma GCC unroll 16
  for (std::size_t i = 0; i < bytes; i += kCacheLine) __builtin_prefetch(first + i);
}

template <class T>
void prefetch(const std::vector<T>& all) {
  prefetch(all.data(), all.size() * sizeof(T));
}

}  // namespace hal
