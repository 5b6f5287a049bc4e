#include "idl/ros/markers.h"

#include "idl/ros/values.h"

namespace idl::ros {
namespace {

using visualization_msgs::msg::dds_::Marker_;

std_msgs::msg::dds_::ColorRGBA_ opaque(const hal::Colour& colour) {
  std_msgs::msg::dds_::ColorRGBA_ ros;
  ros.r(colour.red);
  ros.g(colour.green);
  ros.b(colour.blue);
  ros.a(1);
  return ros;
}

Marker_ marker_of(const hal::Solid& solid, const hal::Pose2& pose) {
  const hal::Vec3 centre = hal::centre_in_world(solid, pose);
  Marker_ marker;
  marker.header().frame_id("world");
  marker.type(static_cast<std::int32_t>(solid.shape));
  marker.pose().position().x(centre.x);
  marker.pose().position().y(centre.y);
  marker.pose().position().z(centre.z);
  marker.pose().orientation(to_quaternion(pose.theta + solid.yaw));
  marker.scale().x(solid.size.x);
  marker.scale().y(solid.size.y);
  marker.scale().z(solid.size.z);
  return marker;
}

}  // namespace

void add_markers(std::vector<Marker_>& markers, hal::Time at, const std::string& name,
                 const PlacedBody& placed) {
  markers.reserve(markers.size() + placed.body.solids.size());
  for (const hal::Solid& solid : placed.body.solids) {
    Marker_& marker = markers.emplace_back(marker_of(solid, placed.pose));
    marker.header().stamp(to_ros(at));
    marker.ns(name);
    marker.id(static_cast<std::int32_t>(&solid - placed.body.solids.data()));
    marker.color(opaque(hal::colour_of(placed.body.kind)));
  }
}

}  // namespace idl::ros
