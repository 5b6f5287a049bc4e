#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "hal/files/config/document.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/world_section.h"
#include "tests/support/slope.h"

namespace sim::scenario {
namespace {

TEST(Walls, StandOnTheGround) {
  const auto file =
      std::filesystem::path(testing::TempDir()) / ("walls" + std::to_string(::getpid()) + ".yaml");
  std::ofstream(file) << "walls: [{size: [6 m, 20 cm, 50 cm], position: [20 m, 3 m]}]\n";
  agents::SimulationConfig config;
  config.world.ground = std::make_shared<tests::Slope>(1, 0.1);
  auto document = hal::files::config::Document::load(file);
  auto root = document.root();
  hal::files::description::FieldReader reader(root);
  std::vector<WorldMap> maps;
  world_keys(reader, config, maps);
  ASSERT_EQ(config.walls.size(), 1u);
  EXPECT_NEAR(config.walls[0].centre.z, 1 + 2 + 0.25, 1e-12);  // m
}

}  // namespace
}  // namespace sim::scenario
