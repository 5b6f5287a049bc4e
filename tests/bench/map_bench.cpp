#include <fmt/format.h>
#include <sys/resource.h>
#include <time.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "sim/scenario/map_section.h"
#include "tests/unit/sim/maps/floors.h"
#include "tests/unit/sim/maps/map_files.h"

/// What a map costs.
///
///   map_bench walls [SIDE=4000]              from the files to walls: number, CPU time, memory
///   map_bench files FOLDER [SIDE=1000] [ROBOTS=20]
///       writes floor.pgm, floor.yaml and two scenarios for `baraka run`: map.yaml, in which robots
///       with scanners drive through the offices, and hall.yaml, the same without inner walls
namespace sim::maps::test {
namespace {

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

long peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

void write_floor(const std::filesystem::path& folder, std::size_t side) {
  std::ofstream(folder / "floor.pgm", std::ios::binary) << pgm(OfficeFloor(side, 1).image());
  std::ofstream(folder / "floor.yaml") << yaml("floor.pgm");
}

/// The image is drawn by another process, so that its memory is not counted.
int measure_walls(const char* self, std::size_t side) {
  const Folder folder;
  if (std::system(fmt::format("{} floor {} {}", self, folder.path().string(), side).c_str()) != 0)
    return 1;
  scenario::WorldMap map;
  map.file = folder.path() / "floor.yaml";
  const double before = cpu_seconds();
  const std::size_t count = scenario::walls_of(map, FlatGround()).size();
  fmt::print("{0} x {0} cells: {1} walls, {2:.3f} s of CPU, {3} MB at most\n", side, count,
             cpu_seconds() - before, peak_megabytes());
  return 0;
}

/// Robots in the corridors, or at the same places in a hall as large.
std::string scenario_text(const std::string& world, std::size_t side, int robots) {
  const double edge = 0.05 * (static_cast<double>(side) / 40 + 6);
  std::string poses;
  for (int i = 0; i < robots; ++i) {
    const int row = i % 3;
    const double from_top = edge + 0.05 * (260 * row + 130);
    poses += fmt::format("\n      - {{x: {} m, y: {} m, yaw: {} deg}}", edge + 3 + 6 * (i / 3),
                         0.05 * static_cast<double>(side) - from_top, 37 * i % 360);
  }
  return fmt::format(
      "version: 1\nworld: {}\nradio: {{profile: ideal, range: 100 m}}\nagents:\n  robots:\n"
      "    name: r{{}}\n    robot:\n      include: {}/robots/robertino.yaml\n"
      "      sensors: [{{kind: scan, position: [0 m, 0 m, 43 cm], min_range: 12 cm,"
      " max_range: 12 m, period: 100 ms}}]\n    poses:{}\n"
      "    controller: {{program: scanner}}\nrecord: {{messages: none}}\n"
      "end: [{{at: 60 s, result: done}}]\n",
      world, CONFIG_DIR, poses);
}

int write_files(const std::filesystem::path& folder, std::size_t side, int robots) {
  std::filesystem::create_directories(folder);
  write_floor(folder, side);
  const double metres = 0.05 * static_cast<double>(side);
  std::string walls;
  for (const double at : {0.0, metres})
    walls += fmt::format(
        "{{size: [{0} m, 0.3 m, 2.5 m], position: [{1} m, {2} m]}}, "
        "{{size: [0.3 m, {0} m, 2.5 m], position: [{2} m, {1} m]}}, ",
        metres, metres / 2, at);
  std::ofstream(folder / "map.yaml") << scenario_text("{map: {file: floor.yaml}}", side, robots);
  std::ofstream(folder / "hall.yaml")
      << scenario_text(fmt::format("{{walls: [{}]}}", walls), side, robots);
  return 0;
}

}  // namespace
}  // namespace sim::maps::test

int main(int argc, char** argv) {
  using namespace sim::maps::test;
  const auto argument = [&](int i, int otherwise) {
    return argc > i ? std::atoi(argv[i]) : otherwise;
  };
  const std::string_view what = argc > 1 ? argv[1] : "walls";
  if (what == "walls") return measure_walls(argv[0], static_cast<std::size_t>(argument(2, 4000)));
  if (argc < 3) return 2;
  const auto side = static_cast<std::size_t>(argument(3, 1000));
  if (what == "files") return write_files(argv[2], side, argument(4, 20));
  if (what != "floor") return 2;
  write_floor(argv[2], side);
  return 0;
}
