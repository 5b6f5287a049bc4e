#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "programs/netns/program_time.h"

namespace programs::netns {

/// Finds the file of a program: the name itself if it has a slash, else the first match in the
/// folders.
/// @param folders  as in PATH. @throws std::runtime_error  there is no executable file.
std::filesystem::path program_file(const std::string& name, const std::string& folders);

/// Why a library cannot be preloaded into a program; nullopt if it can. For a script this is
/// decided for the interpreter in its first line. Programs for other machines, statically linked
/// ones and those of another C library ignore LD_PRELOAD.
std::optional<std::string> why_not_preloaded(const std::filesystem::path& program);

/// Checks that the library will be preloaded; called before a program is started.
/// @throws std::runtime_error  the library would be ignored, and is needed.
void require_preloaded(const std::filesystem::path& program, const ProgramTime& time);

}  // namespace programs::netns
