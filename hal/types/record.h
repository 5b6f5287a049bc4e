#pragma once

#include <cstddef>

namespace hal {

/// Longest name of a state or of a recorded value, in bytes.
inline constexpr std::size_t kMaxRecordedName = 64;
/// Names that one agent may give the values it records.
inline constexpr std::size_t kMaxRecordedNames = 64;

}  // namespace hal
