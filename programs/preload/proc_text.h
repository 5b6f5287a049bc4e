#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace programs::preload {

/// The files of /proc that tell of time: proc(5).
enum class ProcFile {
  kUptime,   ///< /proc/uptime
  kStat,     ///< /proc/stat
  kProcess,  ///< /proc/<process>/stat and /proc/<process>/task/<thread>/stat
};

/// Which of them this path is; nothing: none. @param path  as the kernel names an open file.
std::optional<ProcFile> proc_file(std::string_view path);

/// Whether a path could lead to one of them: by its last word.
bool may_be_proc_file(std::string_view path);

/// What a program is to read in place of the kernel's text.
///
/// Seconds since the computer's start go on as CLOCK_BOOTTIME does, so does the start of a process;
/// processor time, also that of all processors in /proc/stat and the second number of /proc/uptime,
/// is the kernel's, since the computer's start, times the factor: between two readings there is no
/// more of it than time, times processors. The time of the computer's start (btime) stays: it is
/// the difference of two clocks that are slowed alike. What is not as expected stays.
std::string as_told(ProcFile file, std::string_view kernel);

}  // namespace programs::preload
