#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <utility>
#include <vector>

#include "gateway/process/command_table.h"
#include "gateway/process/manual.h"

namespace gateway::process {
namespace {

/// The part before the tables: finds the command that the line names so far, and what may follow.
constexpr std::string_view kHead =
    R"bash(# Completion of {0} for bash, made by {0} from the tables by which it reads its command line.
_{1}() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}
  local command="" index options="" commands="" values="" names="" files=""
  for ((index = 1; index < COMP_CWORD; ++index)); do
    case "$command/${{COMP_WORDS[index]}}" in
      {2}) command+=/${{COMP_WORDS[index]}} ;;
    esac
  done
  case "$command" in
)bash";

/// The part after the tables.
constexpr std::string_view kTail = R"bash(  esac
  COMPREPLY=()
  if [[ -n $values ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$values" -- "$word")
    return
  fi
  if [[ -z $files && $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
    return
  fi
  if [[ -n $files ]]; then
    commands=""
  elif [[ -n $names ]]; then
    commands+=" $("$1" list "$names" 2>/dev/null | sed -n 's/^  \([^ ]*\).*/\1/p')"
  fi
  mapfile -t COMPREPLY < <(
    compgen -W "$commands" -- "$word"
    [[ -n $files || {2} ]] && compgen -f -- "$word"
  )
  compopt -o filenames 2>/dev/null
}}
complete -F _{1} {0}
)bash";

/// Collects the paths of all commands: "" for the program, "/topic/list".
void collect(const CLI::App& app, const std::string& path,
             std::vector<std::pair<std::string, const CLI::App*>>& ways) {
  ways.emplace_back(path, &app);
  for (const CLI::App* one : commands_shown(app))
    collect(*one, fmt::format("{}/{}", path, one->get_name()), ways);
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> all;
  for (const CLI::Option* one : options_shown(command)) {
    const std::vector<std::string> names = names_of(*one);
    all.insert(all.end(), names.begin(), names.end());
  }
  return all;
}

/// Words that can be the first argument: commands, and choices of arguments.
std::vector<std::string> words_of(const CLI::App& command) {
  std::vector<std::string> words;
  for (const CLI::App* one : commands_shown(command)) words.push_back(one->get_name());
  for (const CLI::Option* one : arguments_shown(command)) {
    const std::vector<std::string> choices = choices_of(*one);
    words.insert(words.end(), choices.begin(), choices.end());
  }
  return words;
}

/// Whether an argument is named SCENARIO: a file, or a name as in `list scenarios`.
bool takes_a_scenario(const CLI::App& command) {
  for (const CLI::Option* one : arguments_shown(command)) {
    if (one->get_name(true).ends_with("SCENARIO")) return true;
  }
  return false;
}

/// The lines for one command in the table.
std::string entry(const std::string& path, const CLI::App& command) {
  std::string out =
      fmt::format("    \"{}\")\n      options=\"{}\" commands=\"{}\"{}\n", path,
                  fmt::join(option_names(command), " "), fmt::join(words_of(command), " "),
                  takes_a_scenario(command) ? " names=scenarios" : "");
  out += "      case \"$previous\" in\n";
  for (const CLI::Option* one : options_shown(command)) {
    if (!takes_a_value(*one)) continue;
    const std::vector<std::string> choices = choices_of(*one);
    out += fmt::format(
        "        {}) {} ;;\n", fmt::join(names_of(*one), "|"),
        choices.empty() ? "files=1" : fmt::format("values=\"{}\"", fmt::join(choices, " ")));
  }
  return out + "      esac ;;\n";
}

}  // namespace

std::string bash_completion(const CLI::App& app, const std::string& program) {
  std::vector<std::pair<std::string, const CLI::App*>> ways;
  collect(app, "", ways);
  std::vector<std::string> paths;
  paths.reserve(ways.size());
  for (const auto& [path, command] : ways) {
    if (!path.empty()) paths.push_back(path);
  }
  if (paths.empty()) paths.emplace_back("//");  // matches no path
  std::string function = program;
  for (char& c : function) c = c == '-' ? '_' : c;
  std::string out = fmt::format(kHead, program, function, fmt::join(paths, "|"));
  for (const auto& [path, command] : ways) out.append(entry(path, *command));
  // Files are completed after a command; in a program without commands, everywhere.
  const std::string_view has_files = ways.size() > 1 ? "-n $command" : "-z $command";
  return out + fmt::format(kTail, program, function, has_files);
}

}  // namespace gateway::process
