#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <variant>

#include "hal/files/config/errors.h"
#include "sim/scenario/resolved.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {
namespace {

using physics::Movable;
using physics::MovableBox;
using physics::MovableCylinder;
using physics::MovableSphere;

std::filesystem::path movables_file() {
  return std::filesystem::path(testing::TempDir()) /
         ("movables" + std::to_string(::getpid()) + ".yaml");
}

Scenario with_movables(const std::string& items) {
  std::ofstream(movables_file())
      << "version: 1\nradio: {profile: ieee80211b}\nworld:\n  movables:\n"
      << items
      << "agents: {all: {name: s, station: {}, poses: [{x: 0 m, y: 0 m}]}}\n"
         "end: [{at: 1 s, result: done}]\n";
  return load_scenario(movables_file());
}

TEST(Movables, AreReadWithTheirForms) {
  const Scenario scenario = with_movables(
      "    - {name: crate, box: {size: [1 m, 2 m, 3 m]}, mass: 4 kg, position: [5 m, 6 m], yaw: 90 "
      "deg,\n"
      "       elevation: 7 m, velocity: [8 m/s, 9 m/s], friction: 0.3,\n"
      "       radio_loss: {per_crossing: 20 dB, per_metre: 3 dB/m}}\n"
      "    - {cylinder: {radius: 1 m, height: 2 m}, mass: 500 g, position: [50 m, 0 m]}\n"
      "    - {sphere: {radius: 1 m}, mass: 1 kg, position: [60 m, 0 m], rolling_resistance: "
      "0.05}\n");
  const auto& all = scenario.simulation.movables;
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].name, "crate");
  EXPECT_EQ(all[0].form, decltype(Movable::form)(MovableBox{{1, 2, 3}}));
  EXPECT_EQ(all[0].mass, 4);
  EXPECT_EQ(all[0].pose, (hal::Pose2{5, 6, 3.14159265358979323846 / 2}));
  EXPECT_EQ(all[0].elevation, 7);
  EXPECT_EQ(all[0].velocity, (hal::Vec2{8, 9}));
  EXPECT_EQ(all[0].friction, 0.3);
  EXPECT_EQ(all[0].radio_loss, (ObstacleLoss{hal::Decibels{20}, 3}));
  EXPECT_EQ(all[1].name, "movable1");
  EXPECT_EQ(all[1].form, decltype(Movable::form)(MovableCylinder{1, 2}));
  EXPECT_EQ(all[1].mass, 0.5);
  EXPECT_EQ(all[1].friction, 0.6);
  EXPECT_EQ(all[1].rolling_resistance, 0.01);
  EXPECT_TRUE(all[1].radio_loss.is_none());
  EXPECT_EQ(all[2].form, decltype(Movable::form)(MovableSphere{1}));
  EXPECT_EQ(all[2].rolling_resistance, 0.05);
}

TEST(Movables, StandInLayoutsAndStacks) {
  const Scenario scenario = with_movables(
      "    - {name: 'c{}', box: {size: [20 cm, 20 cm, 30 cm]}, mass: 1 kg, stack: 3, elevation: 1 "
      "m,\n"
      "       grid: {columns: 4, rows: 5, spacing: [1 m, 2 m], origin: [10 m, 0 m], yaw: 30 deg}}\n"
      "    - {box: {size: [20 cm, 20 cm, 30 cm]}, mass: 1 kg, line: {count: 2, spacing: 1 m}}\n");
  const auto& all = scenario.simulation.movables;
  ASSERT_EQ(all.size(), 62u);
  EXPECT_EQ(all[0].name, "c0");
  EXPECT_EQ(all[59].name, "c59");
  EXPECT_EQ(all[60].name, "movable1_0");
  EXPECT_EQ(all[61].pose.x, 1);
  for (int level = 0; level < 3; ++level) {  // of the place in the second row and second column
    const Movable& one = all[static_cast<std::size_t>(15 + level)];
    EXPECT_EQ(one.pose, (hal::Pose2{11, 2, 3.14159265358979323846 / 6}));
    EXPECT_DOUBLE_EQ(one.elevation, 1 + 0.3 * level);
  }
}

TEST(Movables, AtRandomDependOnTheSeed) {
  const std::string uniform =
      "    - {sphere: {radius: 1 cm}, mass: 1 kg, uniform: {count: 9, from: [1 m, 1 m], to: [9 m, "
      "9 m], spacing: 0.1 m}}\n";
  const auto first = with_movables(uniform).simulation.movables;
  const auto again = with_movables(uniform).simulation.movables;
  const auto other = load_scenario(movables_file(), {"seed=2"}).simulation.movables;
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(first[i].pose, again[i].pose);
    EXPECT_NE(first[i].pose, other[i].pose);
  }
}

TEST(Movables, AreWrittenAsTheyWereRead) {
  const Scenario scenario = with_movables(
      "    - {name: 'c{}', box: {size: [20 cm, 20 cm, 30 cm]}, mass: 1 kg, stack: 2, velocity: [1 "
      "m/s, 0 m/s],\n"
      "       line: {count: 3, spacing: 1 m, origin: [1 m, 1 m]}}\n"
      "    - {sphere: {radius: 1 m}, mass: 1 kg, position: [60 m, 0 m], rolling_resistance: 0.05,\n"
      "       radio_loss: {per_crossing: 20 dB, per_metre: 3 dB/m}}\n");
  const std::string text = resolved_yaml(scenario);
  std::ofstream(movables_file()) << text;
  const Scenario again = load_scenario(movables_file());
  EXPECT_EQ(resolved_yaml(again), text);
  ASSERT_EQ(again.simulation.movables.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(again.simulation.movables[i].name, scenario.simulation.movables[i].name);
    EXPECT_EQ(again.simulation.movables[i].form, scenario.simulation.movables[i].form);
    EXPECT_EQ(again.simulation.movables[i].pose, scenario.simulation.movables[i].pose);
    EXPECT_EQ(again.simulation.movables[i].elevation, scenario.simulation.movables[i].elevation);
  }
}

TEST(Movables, AreNotWrittenWhereThereAreNone) {
  EXPECT_EQ(resolved_yaml(with_movables("    []\n")).find("movables:"), std::string::npos);
}

}  // namespace
}  // namespace sim::scenario
