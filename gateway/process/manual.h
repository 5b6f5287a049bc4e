#pragma once

#include <string>

namespace CLI {
class App;
}  // namespace CLI

/// Manual pages and completion, generated from the tables by which a program reads its command
/// line.
namespace gateway::process {

/// The manual page of one command in the macros of man(7): purpose, arguments, options and
/// subcommands.
/// @param name  the program and the commands that lead to it: "baraka-topic-list".
std::string manual_page(const CLI::App& command, const std::string& name);

/// Bash functions that complete the command line of `program`: commands, options, values of options
/// that take one of several words, names of scenarios, and files.
std::string bash_completion(const CLI::App& app, const std::string& program);

/// Adds the hidden option --write-manual FOLDER, which writes the manual pages of the program and
/// all its commands to FOLDER/man1 and the completion to FOLDER/completions, and then ends. Call it
/// after complete().
void add_manual(CLI::App& app, const std::string& program);

}  // namespace gateway::process
