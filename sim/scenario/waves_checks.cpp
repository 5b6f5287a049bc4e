#include "sim/scenario/waves_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <variant>

#include "sim/radio/radio_config.h"
#include "sim/scenario/measured_keys.h"

namespace sim::scenario {
namespace {

using agents::AgentConfig;
using hal::files::config::Mapping;
using radio::PropagationConfig;

/// The law in whose chain the ray reflected from the ground cancels that of an antenna on it;
/// empty: none.
std::string_view cancelling_law(const PropagationConfig& propagation) {
  for (const radio::PathLossConfig& loss : propagation.chain) {
    const auto* const rays = std::get_if<radio::TwoRayInterferenceConfig>(&loss);
    const bool cancels = std::holds_alternative<radio::TwoRayGroundConfig>(loss) ||
                         (rays != nullptr && rays->reflection == -1);
    if (cancels) return radio::model_of(loss);
  }
  return {};
}

void check_heights(Mapping& in, const Scenario& scenario, const PropagationConfig& propagation) {
  const std::string_view law = cancelling_law(propagation);
  if (law.empty()) return;
  constexpr const char* kHeight = "antenna_height";
  const auto& agents = scenario.simulation.agents;
  const auto on_ground = [&](const AgentConfig& agent) {
    return agent.radio.antenna_height.value_or(propagation.antenna_height).value == 0;
  };
  const auto found = std::ranges::find_if(agents, on_ground);
  if (found == agents.end()) return;
  const std::string mistake = fmt::format(
      "is 0 m of '{}': with the model {}, the ray reflected from the ground cancels "
      "the direct one, and no frame from there is received; must be above 0 m",
      found->name, law);
  if (!found->radio.antenna_height) return in.within("radio").mistake(kHeight, mistake);
  const auto group = std::ranges::find_if(scenario.groups, [&](const Group& one) {
    return std::ranges::find(one.agents, found->id) != one.agents.end();
  });
  in.within("agents").within(group->name).within("radio").mistake(kHeight, mistake);
}

const radio::MultiWallConfig* multi_wall_of(const PropagationConfig& propagation) {
  for (const radio::PathLossConfig& loss : propagation.chain)
    if (const auto* const law = std::get_if<radio::MultiWallConfig>(&loss)) return law;
  return nullptr;
}

/// The materials that the law names must exist.
void check_law(Mapping law, const std::vector<Material>& own) {
  for (Mapping& wall : law.items("walls")) {
    const std::string name = wall.text({"material", "", ""}, std::string(kDefaultMaterial));
    if (find_material(name, own)) continue;
    wall.mistake("material", fmt::format("unknown material '{}': must be one of {}", name,
                                         names_of_materials(own)));
  }
}

void check_multi_wall(Mapping& in, const Scenario& scenario) {
  for (Mapping& law : in.within("radio").items("propagation")) {
    if (law.text({"model", "", ""}, "") == radio::MultiWallConfig::kModel)
      check_law(law, scenario.simulation.materials);
  }
  for (const char* const key : {"walls", "boxes"}) {
    for (Mapping& wall : in.within("world").items(key)) {
      if (!wall.has("radio_loss")) continue;
      wall.warn("radio_loss", "has no effect: the model multi_wall takes the loss from 'material'");
    }
  }
}

bool has_body_loss(const Scenario& scenario, const PropagationConfig& propagation) {
  return !propagation.body_loss.is_none() &&
         std::ranges::any_of(scenario.simulation.agents,
                             [](const AgentConfig& agent) { return has_body(agent); });
}

bool has_movable_loss(const Scenario& scenario) {
  return std::ranges::any_of(scenario.simulation.movables, [](const physics::Movable& movable) {
    return !movable.radio_loss.is_none();
  });
}

bool can_stop_waves(const Scenario& scenario, const PropagationConfig& propagation) {
  const auto& walls = scenario.simulation.walls;
  const bool has_wall = std::ranges::any_of(
      walls, [](const physics::StaticBox& wall) { return !wall.radio_loss.is_none(); });
  return has_wall || has_movable_loss(scenario) || has_body_loss(scenario, propagation);
}

}  // namespace

void check_waves(Mapping& in, const Scenario& scenario) {
  const radio::WavesConfig* const waves = radio::waves_of(scenario.simulation.radio);
  if (waves == nullptr) return;
  check_heights(in, scenario, waves->propagation);
  for (const radio::PathLossConfig& loss : waves->propagation.chain) {
    if (const auto* const measured = std::get_if<radio::MeasuredConfig>(&loss))
      check_measured(in, scenario, *measured);
  }
  if (multi_wall_of(waves->propagation) != nullptr) {
    check_multi_wall(in, scenario);
    if (waves->propagation.obstacles && !has_movable_loss(scenario) &&
        !has_body_loss(scenario, waves->propagation)) {
      in.within("radio").warn("obstacles",
                              "has no effect: the model multi_wall has the walls, and there is no "
                              "body with body_loss_per_crossing or body_loss_per_metre, nor a "
                              "movable with a radio_loss");
    }
    return;
  }
  if (waves->propagation.obstacles && !can_stop_waves(scenario, waves->propagation)) {
    in.within("radio").warn(
        "obstacles",
        "has no effect: there is no wall or movable with a radio_loss, nor a body with "
        "body_loss_per_crossing or body_loss_per_metre");
  }
}

}  // namespace sim::scenario
