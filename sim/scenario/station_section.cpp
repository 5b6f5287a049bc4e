#include "sim/scenario/station_section.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "sim/scenario/fields.h"

namespace sim::scenario {
namespace {

using agents::CirclePath;
using agents::LinePath;
using agents::PathDescription;
using agents::RandomWaypointPath;
using agents::WaypointPath;

constexpr Range kSpeed{1e-3, 1e3};     // m/s
constexpr Range kPause{0, 1e6};        // s
constexpr Range kRadius{1e-3, 1e6};    // m
constexpr double kLeastLength = 1e-3;  // m

enum class Turn : std::uint8_t { kLeft, kRight };
constexpr std::array<Option<Turn>, 2> kTurns{{{"left", Turn::kLeft}, {"right", Turn::kRight}}};

void speed_key(Fields& io, double& speed) {
  io.needed({"speed", "Speed along the path.", "1.5 m/s"}, "m/s", kSpeed, speed);
}

void pause_key(Fields& io, std::string_view where, hal::Duration& pause) {
  io.duration({"pause", where, "2 s"}, kPause, pause);
}

void keys_of(Fields& io, LinePath& path) {
  speed_key(io, path.speed);
  io.number(
      {"length",
       "Distance after which it turns back to the start, and there again; none: it never turns.",
       "50 m"},
      "m", {kLeastLength, kUnlimited}, path.length);
  pause_key(io, "Pause at each end of the line.", path.pause);
}

void keys_of(Fields& io, CirclePath& path) {
  io.needed({"radius", "Radius of the circle.", "20 m"}, "m", kRadius, path.radius);
  speed_key(io, path.speed);
  Turn turn = path.clockwise ? Turn::kRight : Turn::kLeft;
  io.choice(
      {"turn", "Side on which the centre of the circle lies, seen along the heading at the start.",
       "left"},
      kTurns, turn);
  path.clockwise = turn == Turn::kRight;
}

void check_distinct(Fields& io, const WaypointPath& path) {
  const auto count = path.points.size();
  const auto same = [&](std::size_t a, std::size_t b) { return path.points[a] == path.points[b]; };
  for (std::size_t i = 1; i < count; ++i) {
    if (same(i - 1, i)) io.mistake("points", fmt::format("{} is where {} is", i, i - 1));
  }
  if (path.repeat && count > 0 && same(count - 1, 0))
    io.mistake("points", "with 'repeat: true' the last must not be where the first is");
}

void keys_of(Fields& io, WaypointPath& path) {
  io.list<hal::Vec2>(
      {"points", "Points to visit in this order.", "[{x: 0 m, y: 50 m}, {x: 50 m, y: 50 m}]",
       hal::files::config::kMustBeGiven},
      path.points, [](Fields& point, hal::Vec2& at) {
        point.needed({"x", "x coordinate, world frame.", "8 m"}, "m", kCoordinate, at.x);
        point.needed({"y", "y coordinate, world frame.", "8 m"}, "m", kCoordinate, at.y);
      });
  if (path.points.empty()) io.mistake("points", "no points: give at least one");
  speed_key(io, path.speed);
  pause_key(io, "Pause at each point.", path.pause);
  io.flag({"repeat",
           "Whether it goes on from the last point to the first; if not, it stays at the last.",
           "true"},
          path.repeat);
  check_distinct(io, path);
}

void keys_of(Fields& io, RandomWaypointPath& path) {
  io.needed({"from", "Corner of the rectangle from which the points are drawn, world frame.",
             "[0 m, 0 m]"},
            "m", kCoordinate, path.from);
  io.needed({"to", "Opposite corner of the rectangle, world frame.", "[100 m, 100 m]"}, "m",
            kCoordinate, path.to);
  hal::Vec2 speed{path.speed_low, path.speed_high};
  io.needed(
      {"speed", "Lowest and highest speed; one in between is drawn for the way to each point.",
       "[0.5 m/s, 2 m/s]"},
      "m/s", kSpeed, speed);
  path.speed_low = speed.x;
  path.speed_high = speed.y;
  pause_key(io, "Pause at each point.", path.pause);
  if (speed.y < speed.x) io.mistake("speed", "the largest is below the least");
  if (path.from == path.to) io.mistake("to", "is the same corner as from");
}

/// A station without a path stays where it is.
void keys_of(Fields& /*io*/, std::monostate& /*path*/) {}

const std::array kPaths{
    alternative<PathDescription, LinePath>({"line", "Moves straight ahead from its pose."}),
    alternative<PathDescription, CirclePath>(
        {"circle", "Moves on a circle, starting at its pose."}),
    alternative<PathDescription, WaypointPath>(
        {"waypoints", "Moves from its pose to the listed points."}),
    alternative<PathDescription, RandomWaypointPath>(
        {"random_waypoint",
         "Moves from its pose to random points in a rectangle; depends on the run's seed and the "
         "agent's name."})};

void path_keys(Fields& io, PathDescription& path) {
  std::visit([&io](auto& c) { keys_of(io, c); }, path);
}

}  // namespace

void station_keys(Fields& io, agents::Station& station) {
  io.inside({"path", "How the station moves; without a path it stands still."},
            [&](Fields& path) { path.one_of(kPaths, station.path, path_keys); });
}

}  // namespace sim::scenario
