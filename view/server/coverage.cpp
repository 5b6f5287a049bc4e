#include "view/server/coverage.h"

#include <cstdint>
#include <exception>
#include <vector>

#include "results/coverage/coverage.h"
#include "results/coverage/coverage_classes.h"
#include "view/server/json_text.h"

namespace view::server {
namespace {

namespace map = results::coverage;

/// Points of the layer: as many cells as can be told apart on a screen.
constexpr std::size_t kMostCells = 20'000;
constexpr double kFinestStep = 0.25;  // m

map::Coverage coarse_enough(const sim::agents::SimulationConfig& config) {
  map::CoverageOptions options{.step = hal::Metres{kFinestStep}};
  const map::Area area = map::area_around(config);
  const hal::Vec2 size = area.high - area.low;
  while (size.x * size.y / (options.step.value * options.step.value) > kMostCells)
    options.step.value *= 2;
  return map::coverage_of(config, options);
}

Json layer_json(const map::Coverage& found, const map::NamedLayer& layer) {
  const map::Classes classes = map::classes_of(found, layer.layer);
  JsonArray all, cells;
  for (const auto& one : classes.all)
    all.add(JsonObject().add("label", one.label).add("colour", one.colour).json());
  for (const map::Spot& spot : found.spots) {
    const std::size_t one = classes.of(spot);
    cells.add(one < classes.all.size() ? static_cast<std::int64_t>(one) : std::int64_t{-1});
  }
  return JsonObject()
      .add("name", layer.name)
      .add("title", classes.title)
      .add("classes", all.json())
      .add("cells", cells.json())
      .json();
}

}  // namespace

std::string coverage_json(const sim::scenario::Scenario& scenario) {
  try {
    const map::Coverage found = coarse_enough(scenario.simulation);
    JsonArray layers;
    for (const map::NamedLayer& layer : map::kLayers) layers.add(layer_json(found, layer));
    return JsonObject()
        .add("x", found.area.low.x)
        .add("y", found.area.low.y)
        .add("step", found.step)
        .add("columns", found.columns)
        .add("rows", found.rows)
        .add("height", found.height)
        .add("layers", layers.json())
        .json()
        .text;
  } catch (const std::exception& e) {
    return JsonObject().add("error", std::string(e.what())).json().text;
  }
}

}  // namespace view::server
