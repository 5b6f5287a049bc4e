#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// Access to the tables of CLI11 for manual pages and completion: what --help shows.
namespace gateway::process {

std::vector<const CLI::App*> commands_shown(const CLI::App& app);
std::vector<const CLI::Option*> options_shown(const CLI::App& app);
std::vector<const CLI::Option*> arguments_shown(const CLI::App& app);

/// Names as they are typed: "-h", "--help".
std::vector<std::string> names_of(const CLI::Option& option);
bool takes_a_value(const CLI::Option& option);
/// Description of the values, without CLI11's name of the type: "0 to 232"; else the type.
std::string values_of(const CLI::Option& option);
/// The words that the value can be; empty: it is not limited to words.
std::vector<std::string> choices_of(const CLI::Option& option);

}  // namespace gateway::process
