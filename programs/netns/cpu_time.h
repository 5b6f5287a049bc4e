#pragma once

#include <sys/types.h>

#include <cstdint>
#include <vector>

namespace programs::netns {

/// All that there are beside this one. In the first process of the run, whose /proc shows them all.
std::vector<pid_t> processes_inside();

/// User and system time of all processes that are or were inside, but for this one, ns: those that
/// have been waited for, and those that run. In the first process of the run, whose /proc shows
/// them all. What runs is counted in clock ticks, 10 ms as a rule.
std::int64_t cpu_time_of_programs();

}  // namespace programs::netns
