#pragma once

#include <cstddef>
#include <vector>

namespace hal {

/// Bytes that processors usually fetch at once. Another size would only cost time.
constexpr std::size_t kCacheLine = 64;

/// Asks the processor to fetch memory into its cache, without waiting for it. Has no other effect,
/// whatever the address is.
/// @param from  address of the first byte. @param bytes  how many.
inline void prefetch(const void* from, std::size_t bytes) {
  const auto* const first = static_cast<const char*>(from);
#pragma GCC unroll 16
  for (std::size_t i = 0; i < bytes; i += kCacheLine) __builtin_prefetch(first + i);
}

/// The same for all elements of a vector, though not for what they point to.
template <class T>
void prefetch(const std::vector<T>& all) {
  prefetch(all.data(), all.size() * sizeof(T));
}

}  // namespace hal
