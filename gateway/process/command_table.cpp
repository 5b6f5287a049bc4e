#include "gateway/process/command_table.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>

namespace gateway::process {
namespace {

bool is_word(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
}

}  // namespace

std::vector<const CLI::App*> commands_shown(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); });
}

std::vector<const CLI::Option*> options_shown(const CLI::App& app) {
  return app.get_options(
      [](const CLI::Option* one) { return !one->get_group().empty() && one->nonpositional(); });
}

std::vector<const CLI::Option*> arguments_shown(const CLI::App& app) {
  return app.get_options(
      [](const CLI::Option* one) { return !one->get_group().empty() && one->get_positional(); });
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  names.reserve(option.get_snames().size() + option.get_lnames().size());
  for (const std::string& name : option.get_snames()) names.push_back(fmt::format("-{}", name));
  for (const std::string& name : option.get_lnames()) names.push_back(fmt::format("--{}", name));
  return names;
}

bool takes_a_value(const CLI::Option& option) { return option.get_expected_max() > 0; }

std::string values_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t colon = type.find(':');
  return colon == std::string::npos ? type : type.substr(colon + 1);
}

std::vector<std::string> choices_of(const CLI::Option& option) {
  if (option.get_type_name().find(':') == std::string::npos) return {};
  const std::vector<std::string> words = CLI::detail::split(values_of(option), '|');
  const bool are_words = std::all_of(words.begin(), words.end(), is_word);
  return are_words ? words : std::vector<std::string>{};
}

}  // namespace gateway::process
