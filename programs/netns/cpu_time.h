#pragma once

#include <sys/types.h>

#include <cstdint>
#include <vector>

namespace programs::netns {

/// All other processes in the namespace. Call it in the first process of the run, whose /proc shows
/// them all.
std::vector<pid_t> processes_inside();

/// User and system time [ns] of all processes inside, except this one: of those that have been
/// waited for, and of those that are running. Call it in the first process of the run, whose /proc
/// shows them all. The time of running processes is counted in clock ticks, usually 10 ms.
std::int64_t cpu_time_of_programs();

}  // namespace programs::netns
