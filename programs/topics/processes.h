#pragma once

#include <signal.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace programs::topics {

/// Plays a plan's participant until a signal ends it, and gives `keep` its journal. Returns the
/// exit status.
using Keep = std::function<bool(const std::string& journal)>;
using PlayPart = std::function<int(std::uint32_t participant, const Keep& keep)>;

/// Plays each participant in a process of its own. Passes on SIGTERM and SIGINT; if one of them
/// ends early, the others are ended, too. To be called before there are threads.
/// @param signals  those two, which are blocked.
/// @param journals  those of the processes, in order of `participants`.
/// @return the greatest exit status.
/// @throws std::runtime_error  there is no further process.
int play_apart(const std::vector<std::uint32_t>& participants, const PlayPart& play,
               const sigset_t& signals, std::vector<std::string>& journals);

}  // namespace programs::topics
