#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// What manual pages and completion take from the tables of CLI11: what --help shows.
namespace gateway::process {

std::vector<const CLI::App*> commands_shown(const CLI::App& app);
std::vector<const CLI::Option*> options_shown(const CLI::App& app);
std::vector<const CLI::Option*> arguments_shown(const CLI::App& app);

/// As they are typed: "-h", "--help".
std::vector<std::string> names_of(const CLI::Option& option);
bool takes_a_value(const CLI::Option& option);
/// What its value may be, in words, without CLI11's name of the type: "0 to 232"; else the type.
std::string values_of(const CLI::Option& option);
/// The words of which its value must be one; empty: it need not.
std::vector<std::string> choices_of(const CLI::Option& option);

}  // namespace gateway::process
