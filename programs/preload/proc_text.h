#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace programs::preload {

/// The files of /proc that contain times: proc(5).
enum class ProcFile {
  kUptime,   ///< /proc/uptime
  kStat,     ///< /proc/stat
  kProcess,  ///< /proc/<process>/stat and /proc/<process>/task/<thread>/stat
};

/// Which of these files a path is; none: another file. @param path  the kernel's name of an open
/// file.
std::optional<ProcFile> proc_file(std::string_view path);

/// Whether a path could lead to one of them, judged by its last component.
bool may_be_proc_file(std::string_view path);

/// The text that a program reads in place of the kernel's text.
///
/// Seconds since the computer's start continue as CLOCK_BOOTTIME does, and so do start times of
/// processes. Processor time, including that of all processors in /proc/stat and the second number
/// of /proc/uptime, is the kernel's value since the computer's start times the factor, so that
/// between two readings it does not exceed the elapsed time times the number of processors. The
/// time of the computer's start (btime) is unchanged: it is the difference of two clocks that are
/// slowed equally. Text in an unexpected form is unchanged.
std::string as_told(ProcFile file, std::string_view kernel);

}  // namespace programs::preload
