#pragma once

#include <string>

namespace gateway::domain {

/// From now on messages of Fast DDS go to hal/types/log at level debug, because they report details
/// on which users cannot act, such as invalid data of others. Conditions that users should know are
/// reported as errors by this program itself.
void take_over_library_log();

/// " (Fast DDS: …)" with the latest message of Fast DDS, for the message of a failure; empty if
/// there is none.
std::string last_words_of_library();

}  // namespace gateway::domain
