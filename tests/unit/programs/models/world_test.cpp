// Worlds in SDF, as `world: {sdf: FILE}` of a scenario.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/scenario/scenario.h"
#include "tests/unit/programs/models/loaded.h"

namespace programs::models::test {
namespace {

std::string scenario(const std::string& world) {
  return "version: 1\nradio: {profile: ideal}\nworld:\n" + world +
         "agents:\n  motes:\n    name: m{}\n    mote: {include: " + std::string(CONFIG_DIR) +
         "/robots/mote.yaml}\n    poses: [{x: 50 m, y: 50 m}]\n    controller: {program: "
         "help_mote}\n"
         "end: [{at: 1 s, result: done}]\n";
}

void expect_wall(const sim::physics::StaticBox& wall, const std::string& name,
                 const hal::Vec3& size, const hal::Vec3& centre, double yaw) {
  EXPECT_EQ(wall.name, name);
  constexpr double kMesh = 1e-8;  // m: corners of meshes are single precision
  EXPECT_NEAR(wall.size.x, size.x, kMesh);
  EXPECT_NEAR(wall.size.y, size.y, kMesh);
  EXPECT_NEAR(wall.size.z, size.z, kMesh);
  EXPECT_NEAR(wall.centre.x, centre.x, kMesh);
  EXPECT_NEAR(wall.centre.y, centre.y, kMesh);
  EXPECT_NEAR(wall.centre.z, centre.z, kMesh);
  EXPECT_NEAR(wall.yaw, yaw, kMesh);
}

TEST(SdfWorld, StaticModelsAreWallsFromTheGroundUp) {
  const Folder folder;
  const auto file =
      folder.write("scenario.yaml",
                   scenario("  sdf: " + robots() + "room.sdf\n  search_path: " + robots() + "\n"));
  const auto read = sim::scenario::load_scenario(file);
  const auto& walls = read.simulation.walls;
  ASSERT_EQ(walls.size(), 4U);
  expect_wall(walls[0], "wall", {4, 0.2, 1}, {1, 2, 0.5}, 0.5);
  EXPECT_EQ(walls[0].friction, 0.7);
  expect_wall(walls[1], "pillar", {0.6, 0.6, 2}, {-1, 0, 1}, 0);
  expect_wall(walls[2], "lamp", {0.4, 0.4, 2.2}, {0, 0, 1.1}, 0);
  expect_wall(walls[3], "lamp_2", {0.2, 0.1, 0.14}, {2, 0, 0.07}, 0);
}

TEST(SdfWorld, OtherModelsAreMovables) {
  const Folder folder;
  const auto file =
      folder.write("scenario.yaml",
                   scenario("  sdf: " + robots() + "room.sdf\n  search_path: " + robots() + "\n"));
  const auto read = sim::scenario::load_scenario(file);
  const auto& movables = read.simulation.movables;
  ASSERT_EQ(movables.size(), 4U);
  EXPECT_EQ(movables[0].name, "crate");
  EXPECT_EQ(movables[0].mass, 1);  // what SDF gives to a link without <inertial>
  EXPECT_EQ(movables[0].pose.x, 3);
  EXPECT_NEAR(movables[0].elevation, 0, 1e-12);
  EXPECT_NEAR(std::get<sim::physics::MovableBox>(movables[0].form).size.z, 0.2, 1e-12);
  EXPECT_EQ(movables[1].name, "big_ball");
  EXPECT_EQ(movables[1].mass, 2.5);
  EXPECT_EQ(movables[1].friction, 0.3);
  EXPECT_EQ(std::get<sim::physics::MovableSphere>(movables[1].form).radius, 0.25);
  EXPECT_NEAR(movables[2].elevation, 1, 1e-12);
  const auto& barrel = std::get<sim::physics::MovableCylinder>(movables[2].form);
  EXPECT_EQ(barrel.radius, 0.2);
  EXPECT_NEAR(barrel.height, 0.4, 1e-12);
  // A bench of two boxes: one box around both, turned as the bench is.
  EXPECT_EQ(movables[3].mass, 2);
  const auto& bench = std::get<sim::physics::MovableBox>(movables[3].form);
  const bool is_along = std::abs(bench.size.x - 1) < 1e-9;
  EXPECT_NEAR(is_along ? bench.size.y : bench.size.x, 0.4, 1e-9);
  EXPECT_NEAR(is_along ? bench.size.x : bench.size.y, 1, 1e-9);
  EXPECT_NEAR(bench.size.z, 0.45, 1e-9);
  EXPECT_NEAR(movables[3].pose.theta, is_along ? 0.5 : 0.5 - 1.5707963267948966, 1e-9);
}

TEST(SdfWorld, KeysBesideItReplaceWhatTheFileSays) {
  const Folder folder;
  const auto file = folder.write(
      "scenario.yaml",
      scenario("  sdf: " + robots() + "room.sdf\n  search_path: " + robots() +
               "\n  walls: {remove: [lamp], add: [{name: own, size: [1 m, 1 m, 1 m], position: "
               "[9 m, 9 m]}]}\n"));
  const auto read = sim::scenario::load_scenario(file);
  const auto& walls = read.simulation.walls;
  ASSERT_EQ(walls.size(), 4U);
  EXPECT_EQ(walls[2].name, "lamp_2");
  EXPECT_EQ(walls[3].name, "own");
}

/// A world of boxes of 0.3 x 0.2 x 0.2 m in rows, each turned by another angle, half of them
/// stacked.
std::string hundred_boxes() {
  std::string text = "<sdf version=\"1.9\"><world name=\"boxes\">\n";
  for (int i = 0; i < 100; ++i) {
    text += "<model name=\"box" + std::to_string(i) + "\"><pose>" +
            std::to_string(0.6 * (i % 50 % 10)) + " " + std::to_string(0.6 * (i % 50 / 10)) +
            (i < 50 ? " 0.1" : " 0.3") + " 0 0 " + std::to_string(0.1 * (i % 50)) +
            "</pose><link name=\"link\"><collision name=\"box\"><geometry><box><size>0.3 0.2 0.2"
            "</size></box></geometry></collision></link></model>\n";
  }
  return text + "</world></sdf>\n";
}

TEST(SdfWorld, AHundredBoxesRestWhereTheyAre) {
  const Folder folder;
  const auto boxes = folder.write("boxes.sdf", hundred_boxes());
  const auto file = folder.write("scenario.yaml", scenario("  sdf: " + boxes.string() + "\n"));
  const auto read = sim::scenario::load_scenario(file);
  sim::physics::World world(read.simulation.world);
  for (const auto& movable : read.simulation.movables) world.add_movable(movable);
  ASSERT_EQ(world.movable_count(), 100U);
  for (int i = 0; i < 200; ++i) world.step();
  std::vector<hal::Vec3> settled;
  for (std::size_t i = 0; i < 100; ++i) settled.push_back(world.movable(i).pose.position);
  // The upper ones still stand on the lower ones.
  for (std::size_t i = 0; i < 50; ++i) EXPECT_NEAR(settled[i + 50].z - settled[i].z, 0.2, 1e-3);
  for (int i = 0; i < 6000; ++i) world.step();
  for (std::size_t i = 0; i < 100; ++i) {
    const hal::Vec3 moved = world.movable(i).pose.position - settled[i];
    EXPECT_LT(std::sqrt(hal::dot(moved, moved)), 1e-4) << i;  // m in 60 s
  }
}

TEST(SdfWorld, AFileWithoutAWorldIsAMistake) {
  const Folder folder;
  const auto file =
      folder.write("scenario.yaml", scenario("  sdf: " + robots() + "gz_drive.sdf\n"));
  try {
    sim::scenario::load_scenario(file);
    FAIL();
  } catch (const hal::files::config::ConfigErrors& errors) {
    EXPECT_NE(errors.messages().at(0).find("gz_drive.sdf:1:1: world: has 0 worlds, not one"),
              std::string::npos)
        << errors.what();
  }
}

}  // namespace
}  // namespace programs::models::test
