#pragma once

#include <string>

namespace CLI {
class App;
}  // namespace CLI

/// Manual pages and completion, made from the tables by which a program reads its command line.
namespace gateway::process {

/// The manual page of one command, in the macros of man(7): what it is for, its arguments, options
/// and commands.
/// @param name  "baraka-topic-list": the program and the commands that lead to it.
std::string manual_page(const CLI::App& command, const std::string& name);

/// Functions of bash that complete the command line of `program`: commands, options, the values of
/// options that take one of some words, scenarios by their names, and files.
std::string bash_completion(const CLI::App& app, const std::string& program);

/// To be called after complete(): the hidden option --write-manual FOLDER, which writes the manual
/// pages of the program and of all of its commands into FOLDER/man1, the completion into
/// FOLDER/completions, and ends.
void add_manual(CLI::App& app, const std::string& program);

}  // namespace gateway::process
