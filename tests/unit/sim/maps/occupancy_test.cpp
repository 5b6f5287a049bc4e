#include "sim/maps/occupancy.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "hal/files/config/errors.h"
#include "tests/unit/sim/maps/map_files.h"

namespace sim::maps::test {
namespace {

using Cells = std::vector<std::int8_t>;

std::vector<std::string> mistakes_of_map(const std::filesystem::path& file) {
  try {
    read_map_file(file);
  } catch (const hal::files::config::ConfigErrors& e) {
    return e.messages();
  }
  return {};
}

Cells cells_of(const Folder& folder, const std::string& levels, const std::string& keys) {
  folder.write("m.pgm", pgm({levels}));
  return read_cells(read_map_file(folder.write("m.yaml", yaml("m.pgm", keys)))).cells;
}

TEST(MapFile, HasTheKeysOfNav2) {
  const Folder folder;
  folder.write("floor.pgm", drawn({"#"}));
  const MapFile map = read_map_file(folder.write(
      "floor.yaml",
      "image: floor.pgm\nmode: scale\nresolution: 5.0e-02\norigin: [-10.5, -.25, 1.5]\n"
      "negate: 1\noccupied_thresh: 0.65\nfree_thresh: 0.25\nfloor_id: 3\n"));
  EXPECT_EQ(map.image, std::filesystem::weakly_canonical(folder.path() / "floor.pgm"));
  EXPECT_EQ(map.mode, Mode::kScale);
  EXPECT_EQ(map.resolution, 0.05);
  EXPECT_EQ(map.origin, (hal::Vec2{-10.5, -0.25}));
  EXPECT_EQ(map.yaw, 1.5);
  EXPECT_TRUE(map.negate);
  EXPECT_EQ(map.occupied_thresh, 0.65);
  EXPECT_EQ(map.free_thresh, 0.25);
}

TEST(MapFile, SaysWhereItIsWrong) {
  const Folder folder;
  folder.write("floor.pgm", drawn({"#"}));
  const std::string file = folder
                               .write("floor.yaml",
                                      "image: flor.pgm\nresolution: 0\norigin: [0, 0]\n"
                                      "negate: maybe\noccupied_thresh: 0.2\nfree_thresh: 0.3\n")
                               .string();
  const std::vector<std::string> found = mistakes_of_map(file);
  ASSERT_EQ(found.size(), 5U);
  EXPECT_TRUE(found[0].starts_with(file + ":1:8: image: there is no file"));
  EXPECT_TRUE(found[1].starts_with(file + ":2:13: resolution: "));
  EXPECT_TRUE(found[2].starts_with(file + ":3:9: origin: "));
  EXPECT_TRUE(found[3].starts_with(file + ":4:9: negate: "));
  EXPECT_EQ(found[4], file + ":6:14: free_thresh: 0.3 is above occupied_thresh, 0.2");
}

TEST(Cells, OfModeTrinaryAreFreeUnknownOrOccupied) {
  const Folder folder;
  // 254 and 205 are map_saver's free and unknown. 1 - 89 / 255 = 0.651, 1 - 90 / 255 = 0.647.
  const std::string levels("\x00\x59\x5a\xcd\xce\xfe", 6);
  const Cells expected{100, 100, -1, -1, 0, 0};
  EXPECT_EQ(cells_of(folder, levels, ""), expected);
  EXPECT_EQ(cells_of(folder, levels, "mode: trinary"), expected);
}

TEST(Cells, AThresholdItselfIsUnknown) {
  const Folder folder;
  folder.write("m.pgm", pgm({std::string("\x33\xcc", 2)}));  // 51 and 204: occupancies 0.8 and 0.2
  const std::string file =
      "image: m.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\n"
      "occupied_thresh: 0.8\nfree_thresh: 0.19999999999999996\n";  // 1 - 0.8 in binary64
  EXPECT_EQ(read_cells(read_map_file(folder.write("m.yaml", file))).cells, (Cells{-1, -1}));
}

TEST(Cells, WithNegateBrightOnesAreOccupied) {
  const Folder folder;
  folder.write("m.pgm", pgm({std::string("\x00\xff", 2)}));
  const auto negated = [&](const std::string& word) {
    return read_cells(read_map_file(folder.write(
                          "m.yaml", fmt::format("image: m.pgm\nresolution: 1\norigin: [0, 0, 0]\n"
                                                "negate: {}\noccupied_thresh: 0.65\n"
                                                "free_thresh: 0.196\n",
                                                word))))
        .cells;
  };
  EXPECT_EQ(negated("1"), (Cells{0, 100}));
  EXPECT_EQ(negated("true"), (Cells{0, 100}));
  EXPECT_EQ(negated("0"), (Cells{100, 0}));
  EXPECT_EQ(negated("false"), (Cells{100, 0}));
}

TEST(Cells, OfModeScaleAreInProportion) {
  const Folder folder;
  // (1 - 147 / 255 - 0.196) / (0.65 - 0.196) = 0.501: 50
  const std::string levels("\x00\x93\xfe", 3);
  EXPECT_EQ(cells_of(folder, levels, "mode: scale"), (Cells{100, 50, 0}));
}

TEST(Cells, OfModeRawAreTheLevels) {
  const Folder folder;
  const std::string levels("\x00\x07\x64\x65\xff", 5);
  EXPECT_EQ(cells_of(folder, levels, "mode: raw"), (Cells{0, 7, 100, -1, -1}));
}

TEST(Cells, TheFirstRowIsTheLowerOne) {
  const Folder folder;
  folder.write("m.pgm", drawn({"#.", "?#"}));
  const OccupancyGrid grid = read_cells(read_map_file(folder.write("m.yaml", yaml("m.pgm"))));
  EXPECT_EQ(grid.width, 2U);
  EXPECT_EQ(grid.height, 2U);
  EXPECT_EQ(grid.cells, (Cells{-1, 100, 100, 0}));
}

TEST(Cells, OfABrokenImageAreAnErrorWithItsName) {
  const Folder folder;
  folder.write("m.pgm", "P5 2 2 255\na");
  const MapFile map = read_map_file(folder.write("m.yaml", yaml("m.pgm")));
  try {
    read_cells(map);
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_EQ(e.what(), map.image.string() + ": ends in row 1");
  }
}

}  // namespace
}  // namespace sim::maps::test
