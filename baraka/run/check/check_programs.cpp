#include "baraka/run/check/check_programs.h"

#include <fmt/format.h>

#include <cstdlib>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "programs/netns/holder.h"
#include "programs/netns/loadable.h"
#include "sim/scenario/plan.h"
#include "sim/scenario/topic_parts.h"

namespace baraka::run::check {
namespace {

/// The search path (PATH) for a program.
std::string path_of(const sim::scenario::Program& program) {
  for (const auto& [name, value] : program.environment) {
    if (name == "PATH") return value;
  }
  const char* const ours = std::getenv("PATH");
  return ours == nullptr ? "" : ours;
}

std::filesystem::path file_of(const sim::scenario::PlannedProgram& planned,
                              const sim::scenario::Scenario& scenario) {
  const std::string& name = planned.program->command.front();
  if (planned.program->is_shipped) return programs::netns::installed_file({}, name.c_str());
  const auto words = sim::scenario::words_of(planned, scenario, {});
  return programs::netns::program_file(filled_in(name, words),
                                       filled_in(path_of(*planned.program), words));
}

}  // namespace

std::set<std::filesystem::path> input_files(const sim::scenario::Scenario& scenario) {
  std::set<std::filesystem::path> files;
  for (const sim::scenario::PlannedProgram& planned : sim::scenario::plan_programs(scenario)) {
    files.insert(file_of(planned, scenario));
  }
  for (const sim::scenario::Group& group : scenario.groups) {
    files.insert(group.dds.profile);
    for (const sim::scenario::TopicItem& topic : group.topics) files.insert(topic.recorded.from);
  }
  for (const sim::scenario::WorldMap& map : scenario.maps) files.insert({map.file, map.image});
  std::erase_if(files, [](const std::filesystem::path& file) {
    std::error_code ignored;
    return !std::filesystem::is_regular_file(file, ignored);
  });
  return files;
}

std::vector<std::string> unusable_programs(const sim::scenario::Scenario& scenario,
                                           const programs::netns::ProgramTime& time) {
  std::vector<std::string> mistakes = sim::scenario::recording_mistakes(scenario);
  std::set<std::string> said;
  for (const sim::scenario::PlannedProgram& planned : sim::scenario::plan_programs(scenario)) {
    const sim::scenario::Program& program = *planned.program;
    const std::string& name = program.command.front();
    if (name.find(sim::scenario::kResultsWord) != std::string::npos) continue;
    try {
      programs::netns::require_preloaded(file_of(planned, scenario), time);
    } catch (const std::runtime_error& e) {
      std::string line = fmt::format("{}: command: {}", program.place, e.what());
      if (said.insert(line).second) mistakes.push_back(std::move(line));
    }
  }
  return mistakes;
}

}  // namespace baraka::run::check
