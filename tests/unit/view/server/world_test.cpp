#include "view/server/world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hal/node/devices/robot_description.h"
#include "hal/types/math.h"
#include "sim/scenario/scenario.h"
#include "tests/unit/view/server/small_result.h"

namespace view::server::test {
namespace {

/// As `baraka view SCENARIO` tells it.
json world_of(const sim::scenario::Scenario& scenario) {
  server::Run run("plan.yaml", scenario, {});
  return ask(run, "world");
}

sim::scenario::Scenario small_plan() {
  sim::scenario::Scenario scenario;
  scenario.name = "plan";
  scenario.simulation = results::record::test::small_config();
  return scenario;
}

hal::node::devices::RobotDescription& robot_of(sim::scenario::Scenario& scenario) {
  return std::get<hal::node::devices::RobotDescription>(scenario.simulation.agents.at(2).body);
}

TEST(World, BoundsAreThoseOfWallsAndBodiesAndNoWider) {
  sim::scenario::Scenario room = small_plan();
  room.simulation.walls = {
      {.name = "south", .centre = {0, -2, 0.25}, .size = {4, 0.1, 0.5}},
      {.name = "east", .centre = {2, 0, 0.25}, .size = {4, 0.1, 0.5}, .yaw = hal::math::kPi / 2}};
  for (auto& agent : room.simulation.agents) agent.pose = {};
  robot_of(room).cylinders = {
      {.radius = 0.25, .z_bottom = 0, .z_top = 0.1, .centre = {0.05, 0}, .mass = 1}};
  room.simulation.agents.at(2).pose = {-3, 0, 0};
  const json bounds = world_of(room).at("bounds");
  EXPECT_NEAR(bounds["x0"], -3.3, 1e-12);  // the robot, whichever way it looks
  EXPECT_NEAR(bounds["x1"], 2.05, 1e-9);
  EXPECT_NEAR(bounds["y0"], -2.05, 1e-9);
  EXPECT_NEAR(bounds["y1"], 2, 1e-9);
}

json channel(const json& world, std::size_t agent, const std::string& name) {
  const json channels = world["channels"][world["agents"][agent]["channels"].get<std::string>()];
  for (const json& one : channels) {
    if (one["name"] == name) return one;
  }
  return nullptr;
}

TEST(World, TellsWhereAScannerIsAndWhereItsRaysGo) {
  sim::scenario::Scenario plan = small_plan();
  robot_of(plan).sensors = {
      hal::node::devices::ScanSensor{.mount = {"lidar", {-0.03, 0.01, 0.18}, 0.5},
                                     .field = 2,
                                     .rays = 5,
                                     .min_range = 0.12,
                                     .max_range = 3.5}};
  const json scan = channel(world_of(plan), 2, "lidar");
  EXPECT_EQ(scan["kind"], "scan");
  EXPECT_EQ(scan["unit"], "m");
  EXPECT_EQ(scan["x"], -0.03);
  EXPECT_EQ(scan["y"], 0.01);
  EXPECT_EQ(scan["z"], 0.18);
  EXPECT_EQ(scan["heading"], 0.5);
  EXPECT_EQ(scan["first"], -1);
  EXPECT_EQ(scan["step"], 0.5);
  EXPECT_EQ(scan["low"], 0.12);
  EXPECT_EQ(scan["high"], 3.5);
  EXPECT_TRUE(scan["values"].empty());
}

TEST(World, TellsNamesAndUnitsOfReadings) {
  sim::scenario::Scenario plan = small_plan();
  robot_of(plan).sensors = {hal::node::devices::PoseSensor{}};
  const json world = world_of(plan);
  EXPECT_EQ(channel(world, 2, "pose")["values"],
            json::parse(R"([["x","m"],["y","m"],["yaw","rad"]])"));
  EXPECT_EQ(channel(world, 2, "odometry")["values"].size(), 6U);
  EXPECT_EQ(channel(world, 0, "localisation")["unit"], "address, m");
  EXPECT_EQ(channel(world, 0, "odometry"), nullptr);
}

TEST(World, StatesKeepTheirOrderWhileMoreAreNamed) {
  SmallResult result("states");
  result.recorder->on_state(Time{1s}, AgentId{1}, "WAIT");
  result.recorder->on_state(Time{2s}, AgentId{2}, "GO");
  result.recorder->on_state(Time{3s}, AgentId{1}, "GO");
  result.recorder->on_state(Time{4s}, AgentId{1}, "ARRIVED");
  result.end(5'000'000'000);
  server::Run run(result.path());
  EXPECT_EQ(ask(run, "world")["states"], json({"WAIT", "GO", "ARRIVED"}));
}

}  // namespace
}  // namespace view::server::test
