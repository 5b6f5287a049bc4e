#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/result.h"

namespace CLI {
class App;
class ParseError;
class Validator;
}  // namespace CLI

/// Common parts of the command lines of all programs.
namespace gateway::process {

/// The longest time on a command line [s]: about 32 years, which fits into int64 ns.
inline constexpr double kLongestSeconds = 1e9;

// Checks for CLI::Option::transform(). They accept only decimal, finite numbers in range, and leave
// a plain number.
CLI::Validator whole_number(std::int64_t low, std::int64_t high);
CLI::Validator plain_number(double low, double high);
/// Accepts "30", which equals "30 s", and "500 ms" and other units of time.
CLI::Validator seconds(double low, double high = kLongestSeconds);
/// Accepts one of the names; for other words the message suggests the nearest name.
CLI::Validator one_of(std::vector<std::string> names);

/// Parses a time as seconds() does. @return s.
hal::Result<double> parse_seconds(std::string_view text, double low, double high = kLongestSeconds);

/// Adds the options that every program has. Call it after all other options and commands have been
/// added. --version prints "`program` (BARAKA x.y.z)"; an option that takes a value refuses an
/// empty one.
void complete(CLI::App& app, const std::string& program);

/// Prints help, the version or the mistake, with suggestions for misspelt commands and options.
/// @return exit status: 0, or 2 after a mistake.
int end_of_parsing(const CLI::App& app, const CLI::ParseError& error);

}  // namespace gateway::process
