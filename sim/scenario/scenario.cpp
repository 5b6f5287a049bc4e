#include "sim/scenario/scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hal/config/document.h"
#include "sim/scenario/agents_section.h"
#include "sim/scenario/bss_section.h"
#include "sim/scenario/events_section.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/loss_section.h"
#include "sim/scenario/network_section.h"
#include "sim/scenario/outcome_section.h"
#include "sim/scenario/overlap_check.h"
#include "sim/scenario/programs_section.h"
#include "sim/scenario/radio_section.h"
#include "sim/scenario/report_section.h"
#include "sim/scenario/run_section.h"
#include "sim/scenario/waves_checks.h"
#include "sim/scenario/world_section.h"

namespace sim::scenario {
namespace {

/// The name becomes that of the results' folder.
std::string read_name(Mapping& in, const std::string& otherwise) {
  std::string name = in.text(
      {"name", "Of the scenario and of the folder of its results: letters, digits, '_' and '-'.",
       "two_motes", "the file's without its ending"},
      otherwise);
  const bool allowed = std::all_of(name.begin(), name.end(), [](char c) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    return letter || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  if (!allowed) {
    in.mistake("name", fmt::format("'{}' must be letters, digits, '_' and '-'", name));
  }
  return name;
}

}  // namespace

Scenario read_scenario(Mapping in, const std::filesystem::path& file) {
  Scenario scenario;
  in.integer({"version", "Of the format of this file.", "1"}, 1, 1);
  scenario.name = read_name(in, file.stem().string());
  read_run(in, scenario);
  read_world(in.mapping({"world", "Walls, boxes and the physics engine."}), scenario.simulation);
  scenario.simulation.radio = read_radio(in.mapping({"radio", "The radio that all agents have."}));
  scenario.simulation.routing = read_routing(in, link_capabilities(scenario.simulation));
  scenario.simulation.localisation = read_localisation(
      in.mapping({"localisation", "What controllers are told of where the others are."}));
  read_agents(
      in.mapping(
          {"agents", "Groups of agents, each under a name of its own (here NAME); at least one."}),
      scenario);
  read_record(in.mapping({"record", "What goes into the results."}), scenario);
  check_access_points(in, scenario);
  check_waves(in, scenario);
  check_networks(in, scenario);
  check_logs(in, scenario);
  check_loss_names(in.within("radio"), scenario);
  read_events(in, scenario);
  read_ends(in, scenario);
  read_expectations(in, scenario);
  scenario.report = read_report(in);
  scenario.compare = read_compare(in);
  in.finish();
  return scenario;
}

Scenario load_scenario(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides) {
  auto document = hal::config::Document::load(file, overrides);
  Scenario scenario = read_scenario(document.root(), file);
  document.finish();
  scenario.warnings = document.warnings();
  std::vector<std::string> overlapping = overlaps(scenario);
  if (!overlapping.empty()) throw hal::config::ConfigErrors(std::move(overlapping));
  return scenario;
}

}  // namespace sim::scenario
