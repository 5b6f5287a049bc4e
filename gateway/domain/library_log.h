#pragma once

#include <string>

namespace gateway::domain {

/// From now on messages of Fast DDS go to hal/types/log at level debug, because they report details
/// on which users cannot act, such as invalid data of others. Important conditions become errors
/// here.
void take_over_library_log();

/// " (Fast DDS: …)" with what it said last, for the message of a failure; empty if it said nothing.
std::string last_words_of_library();

}  // namespace gateway::domain
