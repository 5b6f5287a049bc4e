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

/// The longest time that a command line may name, s: about 32 years, which fits into int64 ns.
inline constexpr double kLongestSeconds = 1e9;

// Checks for CLI::Option::transform(). They take decimal, finite numbers in range and nothing else;
// what they leave is a plain number.
CLI::Validator whole_number(std::int64_t low, std::int64_t high);
CLI::Validator plain_number(double low, double high);
/// Accepts "30", which equals "30 s", and "500 ms" and other units of time.
CLI::Validator seconds(double low, double high = kLongestSeconds);
/// One of some names; suggests the nearest for others.
CLI::Validator one_of(std::vector<std::string> names);

/// A time as seconds() takes it, in s.
hal::Result<double> parse_seconds(std::string_view text, double low, double high = kLongestSeconds);

/// Adds the options of every program. Call it after all other options and commands are added.
/// --version prints "`program` (BARAKA x.y.z)"; an option that takes a value takes no empty one.
void complete(CLI::App& app, const std::string& program);

/// Prints help, the version or the mistake, with suggestions for misspelt commands and options.
/// @return exit status: 0, or 2 after a mistake.
int end_of_parsing(const CLI::App& app, const CLI::ParseError& error);

}  // namespace gateway::process
