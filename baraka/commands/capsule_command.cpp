#include "baraka/commands/capsule_command.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>

#include "baraka/campaign/program_digests.h"
#include "baraka/commands/report_command.h"
#include "baraka/commands/result_folder.h"
#include "baraka/run/check/check_programs.h"
#include "gateway/process/exit_status.h"
#include "gateway/process/find_program.h"
#include "gateway/runtime/plugin.h"
#include "gateway/runtime/python_file.h"
#include "hal/types/printable.h"
#include "results/capsule/capsule.h"
#include "sim/scenario/scenario.h"

namespace baraka::commands {
namespace {

namespace fs = std::filesystem;
using results::capsule::CapsulePart;
using results::capsule::Study;

/// A Python file, and those beside it that it imports, directly and not.
void add_python(const fs::path& file, std::set<fs::path>& files) {
  if (!files.insert(file).second) return;
  static const std::regex import(R"((?:^|\n)\s*(?:from|import)\s+(\w+))");
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  for (std::sregex_iterator at(text.begin(), text.end(), import), end; at != end; ++at) {
    const fs::path beside = file.parent_path() / ((*at)[1].str() + ".py");
    std::error_code ignored;
    if (fs::is_regular_file(beside, ignored)) add_python(beside, files);
  }
}

/// @throws UsageError  the file is in none of the folders
fs::path controller_file(const std::string& name) {
  const auto folders = gateway::runtime::controller_folders();
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    if (fs::is_regular_file(folder / name, ignored)) return folder / name;
  }
  std::string places;
  for (const fs::path& folder : folders) {
    places += (places.empty() ? "" : ", ") + folder.string();
  }
  throw gateway::process::UsageError(fmt::format(
      "the controller {} belongs to the capsule, and is not in {}; BARAKA_CONTROLLER_PATH adds "
      "folders",
      name, places));
}

/// The controllers of a scenario as parts: Python with its text, programs by their digests.
void add_controllers(Study& content, const std::set<std::string>& names) {
  std::set<fs::path> python;
  for (const std::string& name : names) {
    if (gateway::runtime::is_python(name)) {
      add_python(controller_file(name), python);
    } else {
      content.parts.push_back(
          {"controllers/" + name + ".so", controller_file(name + ".so"), false});
    }
  }
  for (const fs::path& file : python) {
    content.parts.push_back({"controllers/" + file.filename().string(), file});
  }
}

/// What the scenarios need beside themselves.
struct Needed {
  std::set<std::string> controllers;
  std::set<fs::path> inputs;
};

/// @param beside  the capsule; a scenario is written there while it is read.
Needed needed_by(const Study& content, const std::string& beside) {
  Needed needed;
  for (const auto& [name, text] : content.scenarios) {
    if (!name.starts_with("scenarios/")) continue;
    const fs::path file = beside + ".scenario.yaml";
    std::ofstream(file, std::ios::binary) << text;
    const sim::scenario::Scenario scenario = sim::scenario::load_scenario(file);
    fs::remove(file);
    needed.controllers.merge(campaign::controllers_of(scenario));
    needed.inputs.merge(run::check::input_files(scenario));
  }
  return needed;
}

/// The page of the report; empty, and said: this installation has none.
std::string page_for(const std::string& folder) {
  try {
    return page_of(folder);
  } catch (const std::exception& error) {
    fmt::print(stderr, "no report in the capsule: {}\n", hal::printable(error.what()));
    return {};
  }
}

void check_file(const std::string& file) {
  const fs::path folder = fs::path(file).parent_path();
  if (folder.empty() || fs::is_directory(folder)) return;
  throw gateway::process::UsageError(
      fmt::format("-o {}: there is no such folder; make it first", file));
}

bool is_program(const fs::path& file) {
  return (fs::status(file).permissions() & fs::perms::owner_exec) != fs::perms{};
}

/// The files that a scenario reads, beside it in the capsule; those of one folder stay together, as
/// one may name the other. Of programs that it starts, only the digests.
void add_inputs(Study& content, const std::set<fs::path>& inputs) {
  std::map<fs::path, std::size_t> folders;
  for (const fs::path& file : inputs) {
    if (is_program(file)) {
      content.parts.push_back({"programs/" + file.filename().string(), file, false});
      continue;
    }
    const std::size_t number = folders.emplace(file.parent_path(), folders.size()).first->second;
    const std::string name = fmt::format("inputs/{}/{}", number, file.filename().string());
    content.parts.push_back({name, file});
    for (auto& [scenario, text] : content.scenarios) {
      for (std::size_t at = 0; (at = text.find(file.string(), at)) != std::string::npos;) {
        text.replace(at, file.string().size(), "../" + name);
        at += name.size();
      }
    }
  }
}

}  // namespace

int capsule(const CapsuleOptions& options) {
  require_result(options.folder);
  check_file(options.file);
  Study content = results::capsule::study_in(options.folder);
  const Needed needed = needed_by(content, options.file);
  add_controllers(content, needed.controllers);
  add_inputs(content, needed.inputs);
  for (const std::string& file : options.added) {
    content.parts.push_back({"added/" + fs::path(file).filename().string(), file});
  }
  content.report = page_for(options.folder);
  results::capsule::write_capsule(content, options.file, options.most_rows);
  fmt::print("runs: {}\ncapsule: {}\n", content.played.size(), hal::printable(options.file));
  return gateway::process::kDone;
}

}  // namespace baraka::commands
