#include "sim/scenario/scenario.h"

#include <utility>

#include "hal/files/config/document.h"
#include "hal/files/description/priority_keys.h"
#include "hal/files/description/routing_section.h"
#include "sim/scenario/agents_section.h"
#include "sim/scenario/bss_section.h"
#include "sim/scenario/events_section.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/ip_routes.h"
#include "sim/scenario/loss_section.h"
#include "sim/scenario/movables_section.h"
#include "sim/scenario/network_section.h"
#include "sim/scenario/outcome_section.h"
#include "sim/scenario/overlap_check.h"
#include "sim/scenario/programs_section.h"
#include "sim/scenario/radio_section.h"
#include "sim/scenario/report_section.h"
#include "sim/scenario/run_section.h"
#include "sim/scenario/static_routes_check.h"
#include "sim/scenario/topics_section.h"
#include "sim/scenario/waves_checks.h"
#include "sim/scenario/world_section.h"

namespace sim::scenario {

namespace {

void note_priorities(const Mapping& in, Scenario& scenario) {
  for (const auto& [topic, priority] : scenario.simulation.routing.priorities) {
    scenario.priority_places[topic] = in.place(topic);
  }
}

/// Checks that involve several sections.
void check_sections(Mapping& in, Scenario& scenario) {
  check_access_points(in, scenario);
  check_waves(in, scenario);
  check_networks(in, scenario);
  find_topics(in, scenario);
  check_logs(in, scenario);
  check_loss_names(in.within("radio"), scenario);
  find_static_routes(in, scenario);
  find_ip_routes(in, scenario);
  note_priorities(in.within("priorities"), scenario);
}

}  // namespace

void keys_of(Fields& io, Scenario& scenario) {
  agents::SimulationConfig& config = scenario.simulation;
  run_keys(io, scenario);
  io.inside({"world", "Walls, boxes, maps, movables and the physics engine."}, [&](Fields& world) {
    world_keys(world, config, scenario.maps);
    movables_key(world, scenario);
  });
  io.inside({"radio", "The radio of all agents."},
            [&](Fields& radio) { keys_of(radio, config.radio); });
  hal::files::description::routing_key(io, config.routing, link_capabilities(config));
  hal::files::description::priorities_key(io, config.routing.priorities);
  io.inside({"localisation", "What controllers learn about the positions of other agents."},
            [&](Fields& own) { keys_of(own, config.localisation); });
  agents_key(io, scenario);
  record_keys(io, scenario);
  if (io.reading() != nullptr) check_sections(*io.reading(), scenario);
  event_keys(io, scenario);
  outcome_keys(io, scenario);
  report_keys(io, scenario.report);
  compare_key(io, scenario.compare);
}

Scenario read_scenario(Mapping in, const std::filesystem::path& file) {
  Scenario scenario;
  scenario.name = file.stem().string();
  FieldReader io(in);
  keys_of(io, scenario);
  in.finish();
  return scenario;
}

Scenario load_scenario(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides) {
  auto document = hal::files::config::Document::load(file, overrides);
  Scenario scenario = read_scenario(document.root(), file);
  document.finish();
  scenario.warnings = document.warnings();
  std::vector<std::string> overlapping = overlaps(scenario);
  if (!overlapping.empty()) throw hal::files::config::ConfigErrors(std::move(overlapping));
  return scenario;
}

}  // namespace sim::scenario
