#include "gateway/view/world.h"

#include "gateway/view/json_text.h"

namespace gateway::view {

using sim::record::Statement;

std::string world_json(Record* record, const sim::scenario::Scenario* scenario,
                       const std::string& name, const std::vector<std::string>& said) {
  (void)scenario;
  JsonObject world;
  world.add("name", name);
  JsonArray agents;
  if (record != nullptr) {
    world.add("result", record->value("result")).add("until", record->until());
    Statement rows =
        record->query("SELECT agent, name, kind, program, x_m, y_m, theta_rad FROM agents");
    while (rows.next()) {
      agents.add(JsonObject()
                     .add("agent", rows.integer(0))
                     .add("name", rows.text(1))
                     .add("kind", rows.text(2))
                     .add("program", rows.text(3))
                     .add("x", rows.real(4))
                     .add("y", rows.real(5))
                     .add("theta", rows.real(6))
                     .json());
    }
  }
  return world.add("agents", agents.json()).add("warnings", json_array(said)).json().text;
}

}  // namespace gateway::view
