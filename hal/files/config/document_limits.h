#pragma once

#include <cstddef>
#include <cstdint>

namespace hal::files::config {

/// How much a document may hold: far more than any simulation needs, and little enough that a file
/// that was made to exhaust its reader is refused in a second.
inline constexpr std::uintmax_t kMostBytes = 8U << 20U;  ///< Of one file.
inline constexpr int kMostFiles = 1000;                  ///< Included ones and the first one.
inline constexpr std::size_t kMostValues = 500'000;      ///< Of all files.
inline constexpr std::size_t kMostKeys = 10'000;         ///< Of one mapping.
inline constexpr int kDeepestInclude = 50;               ///< Mappings around an `include`.
inline constexpr std::size_t kMostParts = 50;            ///< Of the path of an override.

/// Mistakes that are reported, and letters of one; the rest is counted.
inline constexpr std::size_t kMostMessages = 1000;
inline constexpr std::size_t kLongestMessage = 2000;
inline constexpr std::size_t kLongestWord = 500;

}  // namespace hal::files::config
