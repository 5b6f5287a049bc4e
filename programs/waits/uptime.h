#pragma once

namespace programs::waits {

/// Whether it is the file that says how long the computer has been on: proc_uptime(5).
bool is_uptime_file(const char* path);

/// In its place: a file in memory with the run's time, and no time idle.
/// @param flags  of open(). @return as open().
int open_uptime(int flags);

}  // namespace programs::waits
