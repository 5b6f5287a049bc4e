#pragma once

#include <chrono>

namespace hal::hardware {

/// When a device answered, on the clock of this computer that never jumps.
using SteadyTime = std::chrono::steady_clock::time_point;

}  // namespace hal::hardware
