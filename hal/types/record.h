#pragma once

#include <cstddef>

namespace hal {

/// Longest name of a state or of a recorded value, in bytes.
inline constexpr std::size_t kMaxRecordedName = 64;
/// Most names that one agent may use for recorded values.
inline constexpr std::size_t kMaxRecordedNames = 64;

}  // namespace hal
