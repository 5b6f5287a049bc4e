#pragma once

#include <string>

namespace programs::netns {

/// The value of BARAKA_DILATION for programs that all begin now: the factor and the readings of the
/// four clocks (see programs/preload/process_time.h). @param factor  0.01 .. 1.
std::string dilation_from_now(double factor);

}  // namespace programs::netns
