#include "sim/scenario/resolved.h"

#include "sim/scenario/fields.h"
#include "sim/scenario/map_section.h"

namespace sim::scenario {
namespace {

void write(Writer& out, Scenario scenario) {
  drop_map_walls(scenario);
  FieldWriter io(out);
  keys_of(io, scenario);
}

}  // namespace

std::string resolved_yaml(const Scenario& scenario) {
  Writer out;
  write(out, scenario);
  return out.take();
}

std::vector<std::pair<std::string, std::string>> resolved_values(const Scenario& scenario) {
  Writer out;
  write(out, scenario);
  return out.values();
}

}  // namespace sim::scenario
