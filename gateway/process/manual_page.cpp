#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>

#include "gateway/process/command_table.h"
#include "gateway/process/manual.h"

namespace gateway::process {
namespace {

/// Escapes text for roff.
std::string roff(std::string_view text) {
  std::string out;
  out.reserve(2 * text.size());
  bool begins_line = true;
  for (const char c : text) {
    if (begins_line && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') {
      out += "\\(rs";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
    begins_line = c == '\n';
  }
  return out;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// The command as it is typed, "baraka topic list" for "baraka-topic-list". It is made from the
/// tables, because names of commands can have hyphens.
std::string typed(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent == nullptr ? command.get_name() : typed(*parent) + " " + command.get_name();
}

std::string argument(const CLI::Option& option) {
  const std::string name =
      option.get_name(true) +
      (option.get_expected_max() >= CLI::detail::expected_max_vector_size ? "..." : "");
  return option.get_required() ? name : fmt::format("[{}]", name);
}

std::string synopsis(const CLI::App& command) {
  std::string out = fmt::format(".SH SYNOPSIS\n.B {}\n[OPTIONS]", roff(typed(command)));
  for (const CLI::Option* one : arguments_shown(command)) {
    fmt::format_to(std::back_inserter(out), " {}", roff(argument(*one)));
  }
  out += commands_shown(command).empty() ? "\n" : " COMMAND\n";
  return out;
}

/// "Needs: --view" and similar; names are sorted, because the sets have no order.
std::string others(std::string_view what, const std::set<CLI::Option*>& options) {
  if (options.empty()) return {};
  std::vector<std::string> names;
  names.reserve(options.size());
  for (const CLI::Option* one : options) names.push_back(one->get_name());
  std::sort(names.begin(), names.end());
  return fmt::format("\n.br\n{}: {}.", what, roff(fmt::format("{}", fmt::join(names, ", "))));
}

std::string tagged(std::string_view tag, std::string_view text) {
  return fmt::format(".TP\n{}\n{}", tag, text.empty() ? "\\&" : text);
}

std::string option_entry(const CLI::Option& option) {
  std::vector<std::string> names = names_of(option);
  for (std::string& name : names) name = fmt::format("\\fB{}\\fR", roff(name));
  const std::string value = takes_a_value(option) ? " \\fI" + roff(values_of(option)) + "\\fR" : "";
  return tagged(fmt::format("{}{}", fmt::join(names, ", "), value),
                roff(option.get_description())) +
         others("Needs", option.get_needs()) + others("Excludes", option.get_excludes()) + "\n";
}

std::string argument_entry(const CLI::Option& option) {
  const std::vector<std::string> choices = choices_of(option);
  const std::string one_of =
      choices.empty()
          ? ""
          : fmt::format("\n.br\nOne of: {}.", roff(fmt::format("{}", fmt::join(choices, ", "))));
  return tagged(fmt::format("\\fI{}\\fR", roff(option.get_name(true))),
                roff(option.get_description())) +
         one_of + "\n";
}

template <class Entries, class Entry>
std::string section(std::string_view title, const Entries& entries, Entry entry) {
  if (entries.empty()) return {};
  std::string out = fmt::format(".SH {}\n", title);
  for (const auto* one : entries) out.append(entry(*one));
  return out;
}

std::string see_also(const CLI::App& command, const std::string& name) {
  std::vector<std::string> pages;
  const std::vector<const CLI::App*> commands = commands_shown(command);
  pages.reserve(commands.size() + 1);
  for (const CLI::App* one : commands) pages.push_back(fmt::format("{}-{}", name, one->get_name()));
  if (command.get_parent() != nullptr) {
    pages.push_back(name.substr(0, name.size() - command.get_name().size() - 1));
  }
  if (pages.empty()) return {};
  for (std::string& page : pages) page = fmt::format("\\fB{}\\fR(1)", roff(page));
  return fmt::format(".SH SEE ALSO\n{}\n", fmt::join(pages, ",\n"));
}

}  // namespace

std::string manual_page(const CLI::App& command, const std::string& name) {
  const std::string about = command.get_description();
  const std::size_t line = about.find('\n');
  std::string out =
      fmt::format(".TH {} 1 \"\" \"BARAKA {}\" BARAKA\n.SH NAME\n{} \\- {}\n", roff(upper(name)),
                  BARAKA_VERSION, roff(name), roff(about.substr(0, line)));
  out += synopsis(command);
  if (line != std::string::npos)
    out += fmt::format(".SH DESCRIPTION\n{}\n", roff(about.substr(line + 1)));
  out += section("COMMANDS", commands_shown(command), [](const CLI::App& one) {
    return tagged("\\fB" + roff(one.get_name()) + "\\fR", roff(one.get_description())) + "\n";
  });
  out += section("ARGUMENTS", arguments_shown(command), argument_entry);
  out += section("OPTIONS", options_shown(command), option_entry);
  return out + see_also(command, name);
}

}  // namespace gateway::process
