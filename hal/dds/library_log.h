#pragma once

#include <string>

namespace hal::dds {

/// From now on what Fast DDS has to say goes to hal/types/log at level debug: it tells of details
/// that no user can act on, such as the garbage of others. What matters becomes an error here.
void take_over_library_log();

/// " (Fast DDS: …)" with what it said last, for the message of a failure; empty if it said nothing.
std::string last_words_of_library();

}  // namespace hal::dds
