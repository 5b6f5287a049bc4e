#include "gateway/process/command_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <iostream>
#include <limits>
#include <sstream>
#include <utility>

#include "gateway/process/exit_status.h"
#include "hal/files/config/suggest.h"
#include "hal/files/config/value.h"
#include "hal/types/printable.h"
#include "hal/types/terminal_colours.h"

namespace gateway::process {
namespace {

/// In the form that CLI11 needs: replaces the text by the number, or returns what is wrong.
std::string replaced(std::string& text, const hal::Result<double>& value) {
  if (!value) return value.error().message;
  text = fmt::format("{}", *value);
  return {};
}

std::string mistake_in_value(const std::string& text) {
  return text.empty() ? "is given nothing; it takes a value" : std::string{};
}

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* one : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(one->get_name());
  }
  return names;
}

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* one : app.get_options()) {
    for (const std::string& name : one->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// The message for the first unknown word; empty if there is none for which CLI11's own message is
/// not as good.
std::string unknown_word(const CLI::App& app) {
  const auto named = app.get_subcommands();
  if (!named.empty()) {
    if (std::string mistake = unknown_word(*named.front()); !mistake.empty()) return mistake;
  }
  const std::vector<std::string> unknown = app.remaining();
  if (unknown.empty()) return {};
  const std::string& word = unknown.front();
  const CLI::App& command = named.empty() ? app : *named.front();
  if (word.starts_with("-")) {
    return fmt::format(
        "'{}' is no option{}", word,
        hal::files::config::suggestion(word.substr(0, word.find('=')), options_of(command)));
  }
  const std::vector<std::string> commands = commands_of(command);
  if (commands.empty()) return fmt::format("'{}' is one word too many", word);
  return fmt::format("'{}' is no command{}\nCommands: {}", word,
                     hal::files::config::suggestion(word, commands), fmt::join(commands, ", "));
}

}  // namespace

hal::Result<double> parse_seconds(std::string_view text, double low, double high) {
  constexpr double kAny = std::numeric_limits<double>::max();
  const bool has_no_unit = hal::files::config::parse_value(text, "1", -kAny, kAny).has_value();
  return hal::files::config::parse_value(std::string(text) + (has_no_unit ? " s" : ""), "s", low,
                                         high);
}

CLI::Validator whole_number(std::int64_t low, std::int64_t high) {
  const auto check = [low, high](std::string& text) -> std::string {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_whole = error == std::errc{} && end == text.data() + text.size();
    if (is_whole && value >= low && value <= high) return {};
    return fmt::format("'{}' is not a whole number from {} to {}", text, low, high);
  };
  return {check, fmt::format("{} to {}", low, high)};
}

CLI::Validator plain_number(double low, double high) {
  return {[low, high](std::string& text) {
            return replaced(text, hal::files::config::parse_value(text, "1", low, high));
          },
          fmt::format("{} to {}", low, high)};
}

CLI::Validator seconds(double low, double high) {
  return {[low, high](std::string& text) { return replaced(text, parse_seconds(text, low, high)); },
          fmt::format("{} s to {} s; a bare number is in s", low, high)};
}

CLI::Validator one_of(std::vector<std::string> names) {
  const std::string all = fmt::format("{}", fmt::join(names, "|"));
  return {[names = std::move(names)](std::string& text) -> std::string {
            if (std::find(names.begin(), names.end(), text) != names.end()) return {};
            return fmt::format("'{}' is not one of {}{}", text, fmt::join(names, ", "),
                               hal::files::config::suggestion(text, names));
          },
          all};
}

void complete(CLI::App& app, const std::string& program) {
  if (!program.empty()) {
    app.set_version_flag("--version", fmt::format("{} (BARAKA {})", program, BARAKA_VERSION));
  }
  for (CLI::Option* option : app.get_options()) {
    if (option->get_type_size_max() > 0) option->check(mistake_in_value, "");
  }
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    complete(*command, "");
  }
}

int end_of_parsing(const CLI::App& app, const CLI::ParseError& error) {
  const bool is_mistake = error.get_exit_code() != 0;
  const std::string unknown = is_mistake ? unknown_word(app) : "";
  if (unknown.empty()) {
    std::ostringstream said;
    const int status = app.exit(error, std::cout, said) == 0 ? 0 : kUsage;
    fmt::print(stderr, "{}", hal::coloured_for(stderr, hal::Tone::kMistake, said.str()));
    return status;
  }
  hal::print_line(hal::Tone::kMistake,
                  fmt::format("error: {}\nRun with --help for more information.",
                              hal::printable_lines(unknown)));
  return kUsage;
}

}  // namespace gateway::process
