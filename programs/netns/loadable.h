#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace programs::netns {

/// Where a program's file is: itself if its name has a slash, else the first in these folders.
/// @param folders  as in PATH. @throws std::runtime_error  there is none that may be executed.
std::filesystem::path program_file(const std::string& name, const std::string& folders);

/// Why a library cannot be preloaded into a program; nothing if it can. A script is what its first
/// line names. Programs of other machines, statically linked ones and those of another C library
/// ignore LD_PRELOAD.
std::optional<std::string> why_not_preloaded(const std::filesystem::path& program);

/// What is preloaded and what reads it: in place when one may be started.
/// @throws std::runtime_error  at a factor other than 1, if the library would be ignored.
void require_preloaded(const std::filesystem::path& program, double factor);

}  // namespace programs::netns
