// Movables for an MCAP file: transforms and markers.
#include <array>
#include <utility>

#include "hal/types/solid.h"
#include "idl/ros/markers.h"
#include "idl/ros/values.h"
#include "results/report/mcap_streams.h"

namespace results::report {
namespace {

struct MovedMovables {
  tf2_msgs::msg::dds_::TFMessage_ transforms;
  visualization_msgs::msg::dds_::MarkerArray_ markers;
};

hal::Solid::Shape shape_of(const std::string& form) {
  if (form == "sphere") return hal::Solid::Shape::kSphere;
  return form == "cylinder" ? hal::Solid::Shape::kCylinder : hal::Solid::Shape::kBox;
}

geometry_msgs::msg::dds_::Quaternion_ rotation_of(const record::Statement& row, int first) {
  geometry_msgs::msg::dds_::Quaternion_ rotation;
  rotation.w(row.real(first));
  rotation.x(row.real(first + 1));
  rotation.y(row.real(first + 2));
  rotation.z(row.real(first + 3));
  return rotation;
}

/// Columns: at_ns, name, form, three sizes, position and quaternion.
void on_movable_pose(MovedMovables& moved, std::int64_t at, const record::Statement& row) {
  const std::string name = "movables/" + row.text(1);
  const hal::Vec3 place{row.real(6), row.real(7), row.real(8)};
  const auto rotation = rotation_of(row, 9);
  auto& moving = moved.transforms.transforms().emplace_back(
      idl::ros::transform_between("world", name, place, 0));
  moving.header().stamp(idl::ros::to_ros(hal::time_from_ns(at)));
  moving.transform().rotation(rotation);
  hal::Solid solid;
  solid.shape = shape_of(row.text(2));
  solid.size = {row.real(3), row.real(4), row.real(5)};
  const hal::DrawnBody body{name, hal::DrawnAs::kWall, {solid}};
  idl::ros::add_markers(moved.markers.markers(), hal::time_from_ns(at), name, {body, {}});
  auto& pose = moved.markers.markers().back().pose();
  pose.position().x(place.x);
  pose.position().y(place.y);
  pose.position().z(place.z);
  pose.orientation(rotation);
}

/// Results of versions without movables lack their tables.
bool has_movables(record::RunReader& reader) {
  record::Statement row = reader.query("SELECT 1 FROM sqlite_master WHERE name = 'movable_poses'");
  return row.next();
}

}  // namespace

void add_movable_stream(const McapParts& parts, McapStreams& streams) {
  if (!has_movables(parts.reader)) return;
  const auto moved = std::make_shared<MovedMovables>();
  streams.push_back(std::make_unique<McapStream>(
      parts.reader,
      "SELECT p.at_ns, m.name, m.form, m.size_x_m, m.size_y_m, m.size_z_m, p.x_m, p.y_m, p.z_m,"
      " p.qw, p.qx, p.qy, p.qz FROM movable_poses p JOIN movables m USING (movable)"
      " ORDER BY p.at_ns, p.movable",
      [moved](std::int64_t at, const record::Statement& row) { on_movable_pose(*moved, at, row); },
      [parts, moved](std::int64_t at) {
        parts.topics.publish(at, "/tf", moved->transforms);
        parts.topics.publish(at, "/markers", moved->markers, McapTopics::Latched::kYes);
        moved->transforms.transforms().clear();
        moved->markers.markers().clear();
      }));
}

}  // namespace results::report
