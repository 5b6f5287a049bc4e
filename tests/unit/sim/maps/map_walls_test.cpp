#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hal/files/config/errors.h"
#include "hal/types/math.h"
#include "hal/types/random.h"
#include "sim/agents/populated_world.h"
#include "sim/scenario/map_section.h"
#include "sim/scenario/resolved.h"
#include "sim/scenario/scenario.h"
#include "sim/sensing/proximity.h"
#include "sim/sensing/scan.h"
#include "tests/unit/sim/maps/floors.h"
#include "tests/unit/sim/maps/map_files.h"

namespace sim::maps::test {
namespace {

using physics::StaticBox;
using scenario::load_scenario;
using scenario::Scenario;

constexpr const char* kRest =
    "version: 1\nradio: {profile: ideal, range: 100 m}\n"
    "agents: {a: {station: {}, poses: [{x: 0 m, y: 0 m}]}}\nend: [{at: 1 s, result: done}]\n";

/// @param map  value of `world.map`
Scenario scenario_with(const Folder& folder, const std::string& map) {
  return load_scenario(
      folder.write("scenario.yaml", fmt::format("{}world: {{map: {}}}\n", kRest, map)));
}

std::vector<std::string> mistakes(const Folder& folder, const std::string& map) {
  try {
    scenario_with(folder, map);
  } catch (const hal::files::config::ConfigErrors& e) {
    return e.messages();
  }
  return {};
}

/// Map `m` of a drawing.
void write_map(const Folder& folder, const std::vector<std::string>& rows,
               const std::string& keys = {}) {
  folder.write("m.pgm", drawn(rows));
  folder.write("m.yaml", yaml("m.pgm", keys));
}

TEST(MapWalls, StandWhereTheirCellsAre) {
  const Folder folder;
  folder.write("m.pgm", drawn({"....", ".##."}));
  folder.write("m.yaml",
               "image: m.pgm\nresolution: 0.5\norigin: [10, 20, 1.5707963267948966]\nnegate: 0\n"
               "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const Scenario read = scenario_with(folder, "{file: m.yaml, height: 2 m, friction: 0.3}");
  ASSERT_EQ(read.simulation.walls.size(), 1U);
  const StaticBox& wall = read.simulation.walls.front();
  // The middle of the two cells is (1, 0.25) m in the map, whose x axis points north.
  EXPECT_NEAR(wall.centre.x, 10 - 0.25, 1e-12);
  EXPECT_NEAR(wall.centre.y, 20 + 1, 1e-12);
  EXPECT_EQ(wall.centre.z, 1);
  EXPECT_NEAR(wall.size.x, 1, 3e-9);  // and 1 nm on each side
  EXPECT_NEAR(wall.size.y, 0.5, 3e-9);
  EXPECT_EQ(wall.size.z, 2);
  EXPECT_EQ(wall.yaw, 1.5707963267948966);
  EXPECT_EQ(wall.friction, 0.3);
  EXPECT_EQ(wall.name, "m0");
}

TEST(MapWalls, UnknownCellsAreAChoice) {
  const Folder folder;
  write_map(folder, {"##..", "..??"});
  EXPECT_EQ(scenario_with(folder, "{file: m.yaml}").simulation.walls.size(), 1U);
  EXPECT_EQ(scenario_with(folder, "{file: m.yaml, unknown: free}").simulation.walls.size(), 1U);
  EXPECT_EQ(scenario_with(folder, "{file: m.yaml, unknown: occupied}").simulation.walls.size(), 2U);
}

TEST(MapWalls, OfModeRawBeginAtAnOccupancy) {
  const Folder folder;
  folder.write("m.pgm", pgm({std::string("\x64\x64\x00\x41\x41\x00\x40\x40", 8)}));
  folder.write("m.yaml", yaml("m.pgm", "mode: raw"));
  EXPECT_EQ(scenario_with(folder, "{file: m.yaml}").simulation.walls.size(), 1U);
  EXPECT_EQ(scenario_with(folder, "{file: m.yaml, occupied_from: 65}").simulation.walls.size(), 2U);
  EXPECT_EQ(scenario_with(folder, "{file: m.yaml, occupied_from: 64}").simulation.walls.size(), 3U);
}

TEST(MapWalls, SpecksBelowTenCentimetresAreLeftOutUnlessTold) {
  const Folder folder;
  write_map(folder, {"#..##..####", "...........", "....#.#...."});  // cells of 5 cm
  EXPECT_EQ(scenario_with(folder, "{file: m.yaml}").simulation.walls.size(), 2U);
  EXPECT_EQ(scenario_with(folder, "{file: m.yaml, drop_below: 0 m}").simulation.walls.size(), 5U);
  EXPECT_EQ(scenario_with(folder, "{file: m.yaml, drop_below: 15 cm}").simulation.walls.size(), 1U);
}

TEST(MapWalls, OfSeveralFloorsFollowEachOther) {
  const Folder folder;
  write_map(folder, {"##"});
  folder.write("n.yaml", yaml("m.pgm"));
  const Scenario read = scenario_with(
      folder, "[{file: m.yaml}, {file: n.yaml, name: first, elevation: 3 m, height: 2 m}]");
  ASSERT_EQ(read.simulation.walls.size(), 2U);
  EXPECT_EQ(read.simulation.walls[0].centre.z, 1.25);
  EXPECT_EQ(read.simulation.walls[1].centre.z, 4);
  EXPECT_EQ(read.simulation.walls[1].name, "first0");
}

TEST(MapWalls, AreWrittenAsTheirMap) {
  const Folder folder;
  write_map(folder, {"##..##"});
  const Scenario read = scenario_with(
      folder,
      "{file: m.yaml, drop_below: 2 cm, elevation: 1 m, unknown: occupied, "
      "radio_loss: {per_crossing: 3 dB}}, walls: [{size: [1 m, 1 m, 1 m], position: [5 m, 5 m]}]");
  ASSERT_EQ(read.simulation.walls.size(), 3U);
  const std::string text = scenario::resolved_yaml(read);
  EXPECT_EQ(text.find("m0"), std::string::npos);
  EXPECT_NE(text.find((folder.path() / "m.yaml").string()), std::string::npos);
  const Scenario again = load_scenario(folder.write("again.yaml", text));
  EXPECT_EQ(scenario::resolved_yaml(again), text);
  ASSERT_EQ(again.simulation.walls.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(again.simulation.walls[i].name, read.simulation.walls[i].name);
    EXPECT_EQ(again.simulation.walls[i].centre, read.simulation.walls[i].centre);
    EXPECT_EQ(again.simulation.walls[i].radio_loss.per_crossing,
              read.simulation.walls[i].radio_loss.per_crossing);
  }
}

TEST(MapWalls, MistakesHaveThePlacesOfBothFiles) {
  const Folder folder;
  const std::string scenario = (folder.path() / "scenario.yaml").string();
  EXPECT_EQ(
      mistakes(folder, "{file: none.yaml}"),
      (std::vector<std::string>{scenario + ":5:21: world.map.file: there is no file 'none.yaml'"}));
  EXPECT_EQ(mistakes(folder, "{height: 2 m}").size(), 1U);
  folder.write("m.yaml", yaml("m.pgm"));
  const auto missing = mistakes(folder, "{file: m.yaml}");
  ASSERT_EQ(missing.size(), 1U);
  EXPECT_TRUE(missing.front().starts_with(scenario + ":5:21: world.map.file: "));
  EXPECT_NE(missing.front().find("m.yaml:1:8: image: there is no file"), std::string::npos);
  folder.write("m.pgm", "P5 4 4 255\n1234");
  const auto broken = mistakes(folder, "[{file: m.yaml}]");
  ASSERT_EQ(broken.size(), 1U);
  EXPECT_NE(broken.front().find("m.pgm: ends in row 2"), std::string::npos);
}

TEST(MapWalls, AMapOfNothingIsAWarningAndTooManyWallsAMistake) {
  const Folder folder;
  write_map(folder, {"...", "..."});
  EXPECT_EQ(scenario_with(folder, "{file: m.yaml}").warnings.size(), 1U);
  Image board(700, std::string(700, '.'));
  for (std::size_t i = 0; i < 700; ++i)
    for (std::size_t k = i % 2; k < 700; k += 2) board[i][k] = '#';
  write_map(folder, board);
  const auto many = mistakes(folder, "{file: m.yaml}");
  ASSERT_EQ(many.size(), 1U);
  EXPECT_NE(many.front().find("are 245000 boxes, at most 100000 allowed"), std::string::npos);
}

/// The image's cells, and a walk over them.
class CellWalk {
 public:
  static constexpr double kEdge = 0.05;  // m

  explicit CellWalk(const Image& image) : image_(image) {}

  bool is_solid(std::int64_t x, std::int64_t y) const {
    const auto side = static_cast<std::int64_t>(image_.size());
    if (x < 0 || y < 0 || x >= side || y >= side) return false;
    return image_[static_cast<std::size_t>(side - 1 - y)][static_cast<std::size_t>(x)] == '\0';
  }

  struct Walk {
    double distance = 0;  ///< m, to the first solid cell; infinite: none within reach
    double corner = 1;    ///< m, least distance of a corner that was passed
  };
  /// From cell to cell in the order in which the ray crosses their edges.
  Walk walk(hal::Vec2 from, hal::Vec2 direction, double reach) const {
    std::int64_t x = cell(from.x), y = cell(from.y);
    Walk walk;
    while (!is_solid(x, y)) {
      const double to_x = to_edge(from.x, direction.x, x);
      const double to_y = to_edge(from.y, direction.y, y);
      walk.distance = std::min(to_x, to_y);
      if (walk.distance > reach) {
        walk.distance = std::numeric_limits<double>::infinity();
        break;
      }
      note_corner(walk, from, direction, to_x < to_y);
      (to_x < to_y ? x : y) += (to_x < to_y ? direction.x : direction.y) > 0 ? 1 : -1;
    }
    return walk;
  }

 private:
  static std::int64_t cell(double at) { return static_cast<std::int64_t>(std::floor(at / kEdge)); }
  static double to_edge(double from, double slope, std::int64_t cell) {
    if (slope == 0) return std::numeric_limits<double>::infinity();
    return (kEdge * static_cast<double>(cell + (slope > 0 ? 1 : 0)) - from) / slope;
  }
  /// The crossed edge ends in two corners: distance of the nearer one from the ray.
  static void note_corner(Walk& walk, hal::Vec2 from, hal::Vec2 direction, bool is_upright) {
    const hal::Vec2 at = from + walk.distance * direction;
    const double along = is_upright ? at.y : at.x;
    const double beside = std::abs(along - kEdge * std::round(along / kEdge));
    walk.corner = std::min(walk.corner, beside * std::abs(is_upright ? direction.x : direction.y));
  }

  const Image& image_;
};

TEST(MapWalls, RaysMeetThemWhereTheyMeetTheCells) {
  const Folder folder;
  const OfficeFloor floor(1000, 1);
  folder.write("m.pgm", pgm(floor.image()));
  folder.write("m.yaml", yaml("m.pgm"));
  const Scenario read = scenario_with(folder, "{file: m.yaml, drop_below: 0 m}");
  const auto world = agents::populated_world(read.simulation);
  const sensing::Proximity proximity(*world);
  const CellWalk cells(floor.image());
  hal::RandomStream random(1, "scans");
  constexpr double kReach = 8;  // m
  std::size_t compared = 0, hits = 0, near_corners = 0;
  for (int scan = 0; scan < 10'000; ++scan) {
    const hal::Vec3 at{50 * random.uniform(), 50 * random.uniform(), 0.3};
    std::vector<hal::Vec2> rays;
    for (int i = 0; i < 36; ++i)
      rays.push_back(sensing::unit(2 * hal::math::kPi * random.uniform()));
    const auto near = proximity.within(
        {{at.x - kReach, at.y - kReach, at.z}, {at.x + kReach, at.y + kReach, at.z}});
    const auto ranges = sensing::ray_ranges(at, rays, world->shapes(), near, {});
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const CellWalk::Walk walk = cells.walk({at.x, at.y}, rays[i], kReach);
      if (walk.corner < 1e-6) {
        ++near_corners;
        continue;
      }
      ++compared;
      if (std::isinf(walk.distance)) {
        EXPECT_GT(ranges[i], kReach - 1e-4);
        continue;
      }
      ++hits;
      // A ray that meets a side at an angle of 2e-5, the least that stays clear of the corners of a
      // cell, meets it 1 nm / 2e-5 = 0.05 mm too early.
      EXPECT_NEAR(ranges[i], walk.distance, 1e-4);
    }
  }
  EXPECT_GT(hits, 250'000U);
  EXPECT_GT(compared, 350'000U);
  EXPECT_LT(near_corners, 5'000U);
}

TEST(MapWalls, NoRaySlipsBetweenTwoThatTouch) {
  const Folder folder;
  // The teeth are boxes of their own, and the rays run along their seams.
  folder.write("m.pgm", drawn({"#.#.#.#.#", "#########", "#########", "#.#.#.#.#"}));
  for (const double origin : {0.0, 0.1, 0.3, -0.7, 12.35, -17.15}) {
    folder.write("m.yaml",
                 fmt::format("image: m.pgm\nresolution: 0.05\norigin: [{0}, {0}, 0]\nnegate: 0\n"
                             "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
                             origin));
    const Scenario read = scenario_with(folder, "{file: m.yaml, drop_below: 0 m}");
    const auto world = agents::populated_world(read.simulation);
    std::vector<std::size_t> all(world->shapes().size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    for (int line = 1; line < 4; ++line) {
      const std::vector<hal::Vec2> east{{1, 0}};
      const auto ranges = sensing::ray_ranges({origin - 1, origin + 0.05 * line, 0.3}, east,
                                              world->shapes(), all, {});
      EXPECT_NEAR(ranges.front(), 1, 1e-8) << origin << " " << line;
    }
  }
}

TEST(MapWalls, AFloorOfOfficesIsAtMostFiveThousand) {
  const Folder folder;
  folder.write("m.pgm", pgm(OfficeFloor(4000, 1).image()));
  folder.write("m.yaml", yaml("m.pgm"));
  scenario::WorldMap map;
  map.file = folder.path() / "m.yaml";
  const std::vector<StaticBox> walls = scenario::walls_of(map, FlatGround());
  EXPECT_GT(walls.size(), 1000U);
  EXPECT_LE(walls.size(), 5000U);
  const std::vector<StaticBox> again = scenario::walls_of(map, FlatGround());
  ASSERT_EQ(again.size(), walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    EXPECT_EQ(again[i].centre, walls[i].centre);
    EXPECT_EQ(again[i].size, walls[i].size);
  }
}

}  // namespace
}  // namespace sim::maps::test
