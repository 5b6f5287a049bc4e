#include "view/server/movables.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "view/server/tiles.h"

namespace view::server {
namespace {

using results::record::Statement;
using sim::physics::Movable;

constexpr std::array<std::string_view, 3> kFormNames{"box", "cylinder", "sphere"};

/// Results of versions without movables lack their tables.
bool has_movables(Record& record) {
  Statement row = record.query("SELECT 1 FROM sqlite_master WHERE name = 'movable_poses'");
  return row.next();
}

void add_poses(Columns& columns, Statement& row) {
  while (row.next()) {
    columns.add(row.integer(0), row.integer(1), row.real(2), row.real(3), row.real(4), row.real(5),
                row.real(6), row.real(7), row.real(8));
  }
}

constexpr std::string_view kPose = "x_m, y_m, z_m, qw, qx, qy, qz FROM movable_poses";

}  // namespace

Json movables_json(const sim::agents::SimulationConfig& config) {
  JsonArray all;
  for (const Movable& one : config.movables) {
    const hal::Vec3 size = sim::physics::extents(one);
    const hal::Vec3 foot = sim::on(*config.world.ground, {one.pose.x, one.pose.y});
    all.add(JsonObject()
                .add("name", one.name)
                .add("form", kFormNames.at(one.form.index()))
                .add("length_x", size.x)
                .add("length_y", size.y)
                .add("length_z", size.z)
                .add("x", one.pose.x)
                .add("y", one.pose.y)
                .add("z", foot.z + one.elevation + size.z / 2)
                .add("yaw", one.pose.theta)
                .json());
  }
  return all.json();
}

Json movables_json(Record& record) {
  JsonArray all;
  if (!has_movables(record)) return all.json();
  Statement row = record.query(
      "SELECT name, form, size_x_m, size_y_m, size_z_m FROM movables ORDER BY movable");
  while (row.next()) {
    all.add(JsonObject()
                .add("name", row.text(0))
                .add("form", row.text(1))
                .add("length_x", row.real(2))
                .add("length_y", row.real(3))
                .add("length_z", row.real(4))
                .json());
  }
  return all.json();
}

std::string movables_tile(Record& record, const Span& span) {
  Columns columns({"movable", "at", "x", "y", "z", "qw", "qx", "qy", "qz"});
  if (!has_movables(record)) return tile_text(record, span, true, columns);
  Statement before = record.query(fmt::format(
      "SELECT movable, MAX(at_ns), {} WHERE at_ns < ? GROUP BY movable ORDER BY movable", kPose));
  before.bind_all(span.from());
  add_poses(columns, before);
  Statement count = record.query(
      "SELECT COUNT(*) FROM (SELECT 1 FROM movable_poses WHERE at_ns >= ? AND at_ns < ? LIMIT ?)");
  count.bind_all(span.from(), span.to(), kMostPoses + 1);
  const bool is_complete = count.next() && count.integer(0) <= kMostPoses;
  // A summary has the first row of each movable in each part.
  const std::int64_t part = is_complete ? 1 : (span.to() - span.from()) / kBins;
  Statement within = record.query(
      fmt::format("SELECT movable, MIN(at_ns), {} WHERE at_ns >= ? AND at_ns < ? GROUP BY movable, "
                  "at_ns / ? ORDER BY movable, 2",
                  kPose));
  within.bind_all(span.from(), span.to(), part);
  add_poses(columns, within);
  return tile_text(record, span, is_complete, columns);
}

}  // namespace view::server
