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

double read_speed(Mapping& in) {
  return in.number({"speed", "Along the way.", "1.5 m/s"}, "m/s", kSpeed);
}

hal::Duration read_pause(Mapping& in, std::string_view where) {
  return in.duration({"pause", where, "2 s"}, kPause, hal::Duration{});
}

LinePath read_line(Mapping in) {
  LinePath path;
  path.speed = read_speed(in);
  path.length = in.number(
      {"length", "After so far it turns back, and at the start again; none: never.", "50 m"}, "m",
      {kLeastLength, kUnlimited}, path.length);
  path.pause = read_pause(in, "At either end of the line.");
  in.finish();
  return path;
}

CirclePath read_circle(Mapping in) {
  CirclePath path;
  path.radius = in.number({"radius", "Of the circle.", "20 m"}, "m", kRadius);
  path.speed = read_speed(in);
  path.clockwise =
      in.choice(
          {"turn", "On which side of its heading at the start the circle's centre is.", "left"},
          kTurns, Turn::kLeft) == Turn::kRight;
  in.finish();
  return path;
}

void check_distinct(Mapping& in, const WaypointPath& path) {
  const auto count = path.points.size();
  const auto same = [&](std::size_t a, std::size_t b) { return path.points[a] == path.points[b]; };
  for (std::size_t i = 1; i < count; ++i) {
    if (same(i - 1, i)) in.mistake("points", fmt::format("{} is where {} is", i, i - 1));
  }
  if (path.repeat && count > 0 && same(count - 1, 0))
    in.mistake("points", "with 'repeat: true' the last must not be where the first is");
}

WaypointPath read_waypoints(Mapping in) {
  WaypointPath path;
  for (Mapping& point :
       in.mappings({"points", "Where it goes, one after the other.",
                    "[{x: 0 m, y: 50 m}, {x: 50 m, y: 50 m}]", hal::config::kMustBeGiven})) {
    path.points.push_back({point.number({"x", "World frame.", "8 m"}, "m", kCoordinate),
                           point.number({"y", "World frame.", "8 m"}, "m", kCoordinate)});
    point.finish();
  }
  if (path.points.empty()) in.mistake("points", "no points: give at least one");
  path.speed = read_speed(in);
  path.pause = read_pause(in, "At each of the points.");
  path.repeat =
      in.flag({"repeat",
               "Whether it goes on from the last point to the first; else it stays there.", "true"},
              false);
  check_distinct(in, path);
  in.finish();
  return path;
}

RandomWaypointPath read_random_waypoint(Mapping in) {
  RandomWaypointPath path;
  path.from =
      in.vec2({"from", "A corner of the rectangle of the points, world frame.", "[0 m, 0 m]"}, "m",
              kCoordinate);
  path.to = in.vec2({"to", "The opposite corner.", "[100 m, 100 m]"}, "m", kCoordinate);
  const hal::Vec2 speed =
      in.vec2({"speed", "Least and largest; one is drawn for each way.", "[0.5 m/s, 2 m/s]"}, "m/s",
              kSpeed);
  path.speed_low = speed.x;
  path.speed_high = speed.y;
  path.pause = read_pause(in, "At each point.");
  if (speed.y < speed.x) in.mistake("speed", "the largest is below the least");
  if (path.from == path.to) in.mistake("to", "is the same corner as from");
  in.finish();
  return path;
}

PathDescription read_path(Mapping in) {
  PathDescription path;
  const auto refuse_others = [&in](std::string_view taken) {
    for (const std::string name : {"line", "circle", "waypoints", "random_waypoint"}) {
      if (name != taken) in.refuse(name, fmt::format("cannot stand beside {}", taken));
    }
  };
  if (in.has("line")) {
    path = read_line(in.mapping({"line", "Straight on from its pose, where it looks."}));
    refuse_others("line");
  } else if (in.has("circle")) {
    path = read_circle(in.mapping({"circle", "Round and round, from its pose on."}));
    refuse_others("circle");
  } else if (in.has("waypoints")) {
    path = read_waypoints(in.mapping({"waypoints", "From its pose to points that are listed."}));
    refuse_others("waypoints");
  } else if (in.has("random_waypoint")) {
    path = read_random_waypoint(in.mapping(
        {"random_waypoint",
         "From its pose to points drawn from a rectangle, by the run's seed and its name."}));
  }
  in.finish();
  return path;
}

/// Writes a path of each kind.
struct PathWriter {
  Writer& out;

  void operator()(std::monostate) const {}
  void operator()(const LinePath& path) const {
    out.open("line");
    out.number("speed", path.speed, "m/s");
    out.number("length", path.length, "m");
    out.duration("pause", path.pause);
    out.close();
  }
  void operator()(const CirclePath& path) const {
    out.open("circle");
    out.number("radius", path.radius, "m");
    out.number("speed", path.speed, "m/s");
    out.text("turn", path.clockwise ? "right" : "left");
    out.close();
  }
  void operator()(const WaypointPath& path) const {
    out.open("waypoints");
    out.open_list("points");
    for (const hal::Vec2& point : path.points) {
      out.open_item();
      out.number("x", point.x, "m");
      out.number("y", point.y, "m");
      out.close();
    }
    out.close();
    out.number("speed", path.speed, "m/s");
    out.duration("pause", path.pause);
    out.flag("repeat", path.repeat);
    out.close();
  }
  void operator()(const RandomWaypointPath& path) const {
    out.open("random_waypoint");
    out.numbers("from", {path.from.x, path.from.y}, "m");
    out.numbers("to", {path.to.x, path.to.y}, "m");
    out.numbers("speed", {path.speed_low, path.speed_high}, "m/s");
    out.duration("pause", path.pause);
    out.close();
  }
};

}  // namespace

agents::Station read_station_body(Mapping in) {
  agents::Station station{
      .path = read_path(in.mapping({"path", "How it moves; without one it stands."}))};
  in.finish();
  return station;
}

void write_station_body(Writer& out, const agents::Station& station) {
  out.open("station");
  out.open("path");
  std::visit(PathWriter{out}, station.path);
  out.close();
  out.close();
}

}  // namespace sim::scenario
