#include <gtest/gtest.h>

#include "sim/scenario/scenario.h"
#include "tests/unit/view/server/small_result.h"

namespace view::server::test {
namespace {

json coverage_of_plan(const sim::agents::SimulationConfig& config) {
  sim::scenario::Scenario scenario;
  scenario.name = "plan";
  scenario.simulation = config;
  server::Run run("plan.yaml", scenario, {});
  return ask(run, "coverage");
}

sim::agents::SimulationConfig with_access_point() {
  sim::agents::SimulationConfig config = results::record::test::small_config();
  config.radio = sim::radio::profile_defaults(sim::radio::Profile::kIeee80211g);
  dcf_of(config.radio)->bss.access_points = {config.agents.front().name};
  return config;
}

TEST(CoverageLayer, HasACellOfAClassForEachPoint) {
  const json map = coverage_of_plan(with_access_point());
  ASSERT_TRUE(map.contains("layers")) << map;
  const auto cells = map["columns"].get<std::size_t>() * map["rows"].get<std::size_t>();
  EXPECT_GT(cells, 10U);
  EXPECT_LE(cells, 20'500U);
  ASSERT_EQ(map["layers"].size(), 4U);
  EXPECT_EQ(map["layers"][0]["name"], "rssi");
  for (const json& layer : map["layers"]) {
    EXPECT_EQ(layer["cells"].size(), cells);
    for (const json& cell : layer["cells"]) {
      EXPECT_GE(cell, -1);
      EXPECT_LT(cell, static_cast<int>(layer["classes"].size()));
    }
    EXPECT_EQ(layer["classes"][0]["colour"].get<std::string>().size(), 7U);
  }
}

TEST(CoverageLayer, SaysWhyThereIsNone) {
  auto config = with_access_point();
  dcf_of(config.radio)->bss.access_points.clear();
  EXPECT_TRUE(
      coverage_of_plan(config)["error"].get<std::string>().starts_with("there is no access point"));
}

}  // namespace
}  // namespace view::server::test
