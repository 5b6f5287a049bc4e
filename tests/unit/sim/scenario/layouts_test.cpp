#include "sim/scenario/layouts.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "hal/files/config/errors.h"
#include "sim/scenario/resolved.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {
namespace {

namespace fs = std::filesystem;

constexpr double kExact = 1e-9;  // m

fs::path temporary(const std::string& name) {
  return fs::path(testing::TempDir()) / (name + std::to_string(::getpid()) + ".yaml");
}

/// A scenario of one group of stations, `all`.
Scenario stations(const std::string& group, int seed = 1, const std::string& more = "") {
  const fs::path file = temporary("layout");
  std::ofstream(file) << "version: 1\nseed: " << seed << "\nradio: {profile: ieee80211b}\n"
                      << more << "agents:\n  all:\n    name: s{}\n    " << group
                      << "\n    controller: {program: traffic_sink}\n"
                         "end: [{at: 1 s, result: done}]\n";
  return load_scenario(file);
}

std::vector<hal::Pose2> poses(const std::string& layout, int seed = 1) {
  std::vector<hal::Pose2> found;
  for (const auto& agent : stations("station: {}\n    " + layout, seed).simulation.agents)
    found.push_back(agent.pose);
  return found;
}

TEST(Layouts, CirclePlacesAllAtItsRadiusEvenly) {
  const auto placed = poses("circle: {count: 7, radius: 5 m, centre: [10 m, -2 m], yaw: 30 deg}");
  ASSERT_EQ(placed.size(), 7u);
  EXPECT_NEAR(placed[0].x, 15, kExact);
  EXPECT_NEAR(placed[0].y, -2, kExact);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_NEAR(std::hypot(placed[i].x - 10, placed[i].y + 2), 5, kExact);
    const auto& next = placed[(i + 1) % 7];
    EXPECT_NEAR(std::hypot(placed[i].x - next.x, placed[i].y - next.y),
                10 * std::sin(std::acos(-1) / 7), kExact);
    EXPECT_NEAR(placed[i].theta, std::acos(-1) / 6, kExact);
  }
}

TEST(Layouts, LineGoesOnInItsHeading) {
  const auto placed = poses("line: {count: 3, spacing: 10 m, origin: [1 m, 2 m], heading: 90 deg}");
  ASSERT_EQ(placed.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(placed[i].x, 1, kExact);
    EXPECT_NEAR(placed[i].y, 2 + 10.0 * static_cast<double>(i), kExact);
    EXPECT_EQ(placed[i].theta, 0);
  }
}

constexpr const char* kUniform =
    "uniform: {count: 200, from: [-50 m, 0 m], to: [50 m, 60 m], spacing: 4 m}";

TEST(Layouts, UniformKeepsItsAreaAndItsSpacing) {
  const auto placed = poses(kUniform);
  ASSERT_EQ(placed.size(), 200u);
  double left = 0;
  for (const auto& a : placed) {
    EXPECT_TRUE(a.x >= -50 && a.x <= 50 && a.y >= 0 && a.y <= 60);
    left += a.x < 0 ? 1 : 0;
    for (const auto& b : placed) {
      if (&a != &b) {
        EXPECT_GE(std::hypot(a.x - b.x, a.y - b.y), 4);
      }
    }
  }
  EXPECT_NEAR(left, 100, 25);
}

TEST(Layouts, UniformFollowsTheSeed) {
  EXPECT_EQ(poses(kUniform), poses(kUniform));
  EXPECT_NE(poses(kUniform, 2), poses(kUniform));
}

std::string mistake(const std::string& layout) {
  try {
    poses(layout);
  } catch (const hal::files::config::ConfigErrors& errors) {
    return errors.messages().front();
  }
  return "none";
}

TEST(Layouts, SayWhatIsWrong) {
  EXPECT_NE(mistake("uniform: {count: 9, from: [0 m, 0 m], to: [1 m, 1 m], spacing: 2 m}")
                .find(":8:68: agents.all.uniform.spacing: 2 m leave room for 1 of 9 agents"),
            std::string::npos)
      << mistake("uniform: {count: 9, from: [0 m, 0 m], to: [1 m, 1 m], spacing: 2 m}");
  EXPECT_NE(mistake("line: {count: 2, spacing: 1 m}\n    poses: [{x: 0 m, y: 0 m}]")
                .find("agents.all.poses: cannot be combined with line"),
            std::string::npos);
  EXPECT_NE(mistake("circle: {count: 0, radius: 1 m}").find("below the limit of 1"),
            std::string::npos);
  EXPECT_NE(mistake("name2: x").find("agents.all"), std::string::npos);
}

TEST(Stations, MayStandInOneAnotherAndInWalls) {
  const Scenario scenario =
      stations("station: {}\n    line: {count: 3, spacing: 0 m}", 1,
               "world: {walls: [{size: [1 m, 1 m, 1 m], position: [0 m, 0 m]}]}\n");
  EXPECT_EQ(scenario.simulation.agents.size(), 3u);
}

TEST(Stations, AndTheirRoutingAreWrittenAsTheyWereRead) {
  for (const char* path :
       {"", "path: {line: {speed: 2 m/s, length: 30 m, pause: 1 s}}",
        "path: {line: {speed: 2 m/s}}", "path: {circle: {radius: 3 m, speed: 1 m/s, turn: right}}",
        "path: {waypoints: {points: [{x: 1 m, y: 2 m}, {x: 3 m, y: 4 m}], speed: 1 m/s, "
        "pause: 2 s, repeat: true}}",
        "path: {random_waypoint: {from: [0 m, 1 m], to: [2 m, 3 m], speed: [1 m/s, 2 m/s], "
        "pause: 3 s}}"}) {
    const Scenario first = stations("station: {" + std::string(path) +
                                        "}\n    line: {count: 2, spacing: 3 m}\n    routing: ants",
                                    1, "routing: none\n");
    const std::string written = resolved_yaml(first);
    const fs::path file = temporary("resolved");
    std::ofstream(file) << written;
    const Scenario second = load_scenario(file);
    EXPECT_EQ(resolved_yaml(second), written);
    const auto& agents = first.simulation.agents;
    const auto& read = second.simulation.agents;
    ASSERT_EQ(read.size(), agents.size());
    EXPECT_EQ(std::get<agents::Station>(read[1].body), std::get<agents::Station>(agents[1].body));
    EXPECT_EQ(read[1].routing, hal::node::routing::Algorithm::kAnts);
    EXPECT_EQ(second.simulation.routing.algorithm, hal::node::routing::Algorithm::kNone);
  }
}

}  // namespace
}  // namespace sim::scenario
