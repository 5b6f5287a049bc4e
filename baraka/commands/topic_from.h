#pragma once

#include <string>

#include "baraka/commands/topic_command.h"
#include "hal/files/recording/recording.h"

namespace baraka::commands {

/// Prints what a recording holds: a table as comments, then its topics as items of the key
/// `topics:` of a group of agents. @return exit status. @throws std::runtime_error  it cannot be
/// read.
int topics_from(const TopicOptions& options);

/// What topics_from() prints. @param file  as the items name it.
std::string recording_page(const hal::files::recording::Recording& recording,
                           const std::string& file);

}  // namespace baraka::commands
