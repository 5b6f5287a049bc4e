#include "baraka/commands/list_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "baraka/run/controllers/controller_path.h"
#include "gateway/process/exit_status.h"
#include "gateway/runtime/plugin.h"
#include "hal/files/config/shared_folders.h"
#include "hal/types/printable.h"

namespace baraka::commands {
namespace {

namespace fs = std::filesystem;

constexpr const char* kControllers = "controllers";

void print_row(const std::string& name, const std::string& what) {
  fmt::print("  {:<26}  {}\n", hal::printable(name), hal::printable(what));
}

/// Files of a folder with that extension, sorted; empty if the folder cannot be read.
std::vector<fs::path> files_in(const fs::path& folder, const char* extension) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (at->path().extension() == extension) files.push_back(at->path());
  }
  std::ranges::sort(files);
  return files;
}

void list_files(const std::string& kind) {
  for (const fs::path& shared : hal::files::config::shared_folders()) {
    const std::vector<fs::path> files = files_in(shared / kind, ".yaml");
    if (files.empty()) continue;
    fmt::print("{}, in {}:\n", kind, hal::printable((shared / kind).string()));
    for (const fs::path& file : files) {
      std::ifstream in(file, std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(in), {}};
      print_row(file.stem().string(), first_sentence(text));
    }
  }
}

std::string words_of(const hal::ControllerKind& kind) {
  std::vector<std::string> drives, parameters;
  if (kind.make_for_robot != nullptr) drives.emplace_back("robots");
  if (kind.make_for_mote != nullptr) drives.emplace_back("motes and stations");
  for (const hal::ParameterSpec& one : kind.parameters) parameters.push_back(one.name);
  return fmt::format("for {}{}{}", fmt::join(drives, ", "),
                     parameters.empty() ? "" : "; parameters: ", fmt::join(parameters, ", "));
}

/// As a scenario names it: of a plug-in without its extension.
std::string name_of_controller(const fs::path& file) {
  return (file.extension() == ".so" ? file.stem() : file.filename()).string();
}

/// The line about a file with the name of a plug-in; none: the file is not listed.
/// @param by_user  the file is in a folder of BARAKA_CONTROLLER_PATH, which should hold only
///   controllers; BARAKA's own folders may hold other libraries, too.
std::optional<std::string> words_of(const fs::path& file, bool by_user) {
  std::error_code unknown;
  if (fs::is_symlink(file, unknown) && !fs::exists(file, unknown)) {
    if (!by_user) return std::nullopt;
    return fmt::format("a link to {}, which is not there",
                       fs::read_symlink(file, unknown).string());
  }
  const auto kind = gateway::runtime::load_plugin(name_of_controller(file), {file.parent_path()});
  if (kind) return words_of(**kind);
  const bool is_controller = kind.error().code != hal::Errc::kInvalidArgument;
  return by_user || is_controller ? std::optional(kind.error().message) : std::nullopt;
}

/// Whether a Python file looks like a controller: to ask it means to run it, whatever it does.
bool is_python_controller(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return text.find("(baraka.Controller)") != std::string::npos;
}

/// @param seen  names of controllers in earlier folders, which take precedence.
void list_controllers_in(const fs::path& folder, bool by_user, std::set<std::string>& seen) {
  bool is_first = true;
  std::vector<fs::path> files = files_in(folder, ".so");
  if (by_user) {
    std::ranges::copy_if(files_in(folder, ".py"), std::back_inserter(files), is_python_controller);
  }
  for (const fs::path& file : files) {
    const std::string name = name_of_controller(file);
    if (name.starts_with("lib") || seen.contains(name)) continue;  // "lib…" is not a plug-in
    const auto words = words_of(file, by_user);
    std::error_code unknown;
    if (fs::exists(file, unknown)) seen.insert(name);
    if (!words) continue;
    if (std::exchange(is_first, false)) {
      fmt::print("{}, in {}:\n", kControllers, hal::printable(folder.string()));
    }
    print_row(name, *words);
  }
}

void list_controllers() {
  run::controllers::warn_of_missing_controller_folders();
  const std::size_t by_user = gateway::runtime::named_controller_folders().size();
  // Folders of BARAKA_CONTROLLER_PATH come first.
  const std::vector<fs::path> folders = gateway::runtime::controller_folders();
  std::set<std::string> seen;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    list_controllers_in(folders[i], i < by_user, seen);
  }
}

}  // namespace

const std::vector<std::string>& listed_kinds() {
  static const std::vector<std::string> kinds{"scenarios", "campaigns", "fleets",    "robots",
                                              "radios",    "hardware",  kControllers};
  return kinds;
}

std::string first_sentence(std::string_view text) {
  std::string sentence;
  while (text.starts_with('#')) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(1, end - 1);
    text.remove_prefix(std::min(end + 1, text.size()));
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    while (line.ends_with(' ') || line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty()) break;  // a new paragraph
    sentence += (sentence.empty() ? "" : " ") + std::string(line);
    if (sentence.ends_with('.')) break;
  }
  for (const char* stop : {". ", ": ", " ("}) sentence = sentence.substr(0, sentence.find(stop));
  if (sentence.ends_with('.') || sentence.ends_with(':')) sentence.pop_back();
  return sentence;
}

int list(const std::string& kind) {
  for (const std::string& one : listed_kinds()) {
    if (!kind.empty() && kind != one) continue;
    if (one == kControllers) {
      list_controllers();
    } else {
      list_files(one);
    }
  }
  return gateway::process::kDone;
}

}  // namespace baraka::commands
