#include "sim/scenario/resolved.h"

#include "hal/config/writer.h"
#include "sim/scenario/agents_section.h"
#include "sim/scenario/events_section.h"
#include "sim/scenario/outcome_section.h"
#include "sim/scenario/radio_section.h"
#include "sim/scenario/report_section.h"
#include "sim/scenario/run_section.h"
#include "sim/scenario/world_section.h"

namespace sim::scenario {
namespace {

void write(hal::config::Writer& out, const Scenario& scenario) {
  out.integer("version", 1);
  out.text("name", scenario.name);
  write_run(out, scenario);
  write_world(out, scenario.simulation);
  write_radio(out, scenario.simulation.radio);
  write_routing(out, scenario.simulation.routing, link_capabilities(scenario.simulation));
  write_localisation(out, scenario.simulation.localisation);
  write_agents(out, scenario);
  write_events(out, scenario);
  write_ends(out, scenario);
  write_expectations(out, scenario);
  write_report(out, scenario.report);
  write_compare(out, scenario.compare);
}

}  // namespace

std::string resolved_yaml(const Scenario& scenario) {
  hal::config::Writer out;
  write(out, scenario);
  return out.take();
}

std::vector<std::pair<std::string, std::string>> resolved_values(const Scenario& scenario) {
  hal::config::Writer out;
  write(out, scenario);
  return out.values();
}

}  // namespace sim::scenario
