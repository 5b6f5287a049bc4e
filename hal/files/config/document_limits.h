#pragma once

#include <cstddef>
#include <cstdint>

namespace hal::files::config {

/// Limits on a document: far beyond the needs of any simulation, but low enough to refuse within a
/// second a file that was made to exhaust its reader.
inline constexpr std::uintmax_t kMostBytes = 8U << 20U;  ///< Size of one file.
inline constexpr int kMostFiles = 1000;                  ///< The first file and all included ones.
inline constexpr std::size_t kMostValues = 500'000;      ///< In all files together.
inline constexpr std::size_t kMostKeys = 10'000;         ///< In one mapping.
inline constexpr int kDeepestInclude = 50;     ///< Nesting depth of an `include` in mappings.
inline constexpr std::size_t kMostParts = 50;  ///< Parts of the path of an override.

/// Limits on reported mistakes and on characters in one; the rest is only counted.
inline constexpr std::size_t kMostMessages = 1000;
inline constexpr std::size_t kLongestMessage = 2000;
inline constexpr std::size_t kLongestWord = 500;

}  // namespace hal::files::config
