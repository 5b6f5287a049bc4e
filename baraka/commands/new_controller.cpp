#include "baraka/commands/new_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <stdexcept>
#include <vector>

#include "gateway/process/exit_status.h"
#include "gateway/server/teleop_port.h"
#include "hal/files/config/shared_folders.h"
#include "hal/types/terminal_colours.h"

namespace baraka::commands {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 64;

/// Why a name cannot be the name of a program, a class and a CMake target; empty: it can.
std::optional<std::string> mistake_in(const std::string& name) {
  const auto is_allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  const bool begins_well = !name.empty() && name.front() >= 'a' && name.front() <= 'z';
  if (!begins_well || !std::ranges::all_of(name, is_allowed)) {
    return "must be made of a-z, 0-9 and _, and begin with a letter";
  }
  if (name.size() > kLongestName) return fmt::format("is longer than {}", kLongestName);
  // Targets that CMake defines itself (policy CMP0037).
  static const std::set<std::string> of_cmake{
      "all",     "clean",          "depend",     "edit_cache",    "help", "install",
      "package", "package_source", "preinstall", "rebuild_cache", "test"};
  if (of_cmake.contains(name)) return "is a target of every CMake project";
  if (name == "baraka") return "is this program";
  if (name == gateway::server::kTeleop) return "is a controller that is built in";
  return std::nullopt;
}

/// "line_follower" -> "LineFollower".
std::string class_name(const std::string& name) {
  std::string result;
  bool begins = true;
  for (const char c : name) {
    if (c != '_') result += begins ? static_cast<char>(std::toupper(c)) : c;
    begins = c == '_';
  }
  return result;
}

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at)) {
    text.replace(at, what.size(), by);
    at += by.size();
  }
}

std::string filled_in(std::string text, const NewControllerOptions& options) {
  replace_all(text, "@program@", options.name + (options.in_python ? ".py" : ""));
  replace_all(text, "@name@", options.name);
  replace_all(text, "@Name@", class_name(options.name));
  replace_all(text, "@agent@", options.for_mote ? "m0" : "r0");
  return text;
}

void write_filled_in(const fs::path& from, const fs::path& folder,
                     const NewControllerOptions& options) {
  std::ifstream in(from, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw std::runtime_error(from.string() + ": cannot be read");
  const fs::path to = folder / filled_in(from.stem().string(), options);  // without ".in"
  std::ofstream out(to, std::ios::binary);
  out << filled_in(text, options);
  out.close();
  if (!out) throw std::runtime_error(to.string() + ": cannot be written");
  fs::permissions(to, fs::status(from).permissions() | fs::perms::owner_write);
}

/// The folders of templates that make the project; of those in C++ only the scenario counts for
/// one in Python.
std::vector<std::string> parts_of(const NewControllerOptions& options) {
  const std::string kind = options.for_mote ? "mote" : "robot";
  if (options.in_python) return {kind, "python/any", "python/" + kind};
  return {"any", options.from.empty() ? kind : options.from};
}

void write_project(const fs::path& folder, const NewControllerOptions& options) {
  for (const std::string& part : parts_of(options)) {
    const auto relative = fs::path("templates") / part;
    const auto templates = hal::files::config::find_shared(relative);
    if (!templates) {
      throw std::runtime_error(fmt::format("no {} in {}", relative.string(),
                                           hal::files::config::listed_shared_folders()));
    }
    for (const auto& entry : fs::directory_iterator(*templates)) {
      const bool in_cpp = entry.path().stem().extension() == ".cpp";
      if (entry.path().extension() != ".in" || (in_cpp && options.in_python)) continue;
      write_filled_in(entry.path(), folder, options);
    }
  }
}

}  // namespace

std::vector<std::string> new_controller_models() { return {"two_turtlebots"}; }

int new_controller(const NewControllerOptions& options) {
  if (const auto mistake = mistake_in(options.name)) {
    hal::print_line(hal::Tone::kMistake,
                    fmt::format("error: the name '{}' {}", options.name, *mistake));
    return gateway::process::kUsage;
  }
  const fs::path folder = options.to / options.name;
  if (fs::exists(fs::symlink_status(folder))) {
    hal::print_line(hal::Tone::kMistake,
                    fmt::format("error: {} is there already", folder.string()));
    return gateway::process::kUsage;
  }
  if (!options.to.empty() && !fs::is_directory(options.to)) {
    hal::print_line(
        hal::Tone::kMistake,
        fmt::format("error: --to {}: there is no such folder; make it first", options.to.string()));
    return gateway::process::kUsage;
  }
  fs::create_directory(folder);
  try {
    write_project(folder, options);
  } catch (...) {
    fs::remove_all(folder);
    throw;
  }
  fmt::print("{}: a controller for a {}; its README.md says how to {}test and run it\n",
             folder.string(), options.for_mote ? "mote" : "robot",
             options.in_python ? "" : "build, ");
  return gateway::process::kDone;
}

}  // namespace baraka::commands
