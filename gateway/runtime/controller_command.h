#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gateway::runtime {

/// The words that start a controller as a process, without its options: the first executable with
/// the program's name in the folders; for a Python file the interpreter, /usr/bin/python3 or that
/// of the environment variable BARAKA_PYTHON, and how it runs the file. Empty: there is none.
/// @param program  as a scenario names it.
std::vector<std::string> controller_command(const std::string& program,
                                            const std::vector<std::filesystem::path>& folders);

}  // namespace gateway::runtime
