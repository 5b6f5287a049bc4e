#include "view/server/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <variant>

namespace view::server {
namespace {

using hal::node::devices::BodyBox;
using hal::node::devices::BodyCylinder;
using hal::node::devices::MoteDescription;
using hal::node::devices::RobotDescription;
using hal::node::devices::Wheel;

/// Files do not give the width of a wheel; it is drawn with this width, in radii.
constexpr double kDrawnWheelWidth = 0.5;

std::string_view name_of(hal::node::devices::WheelType type) {
  switch (type) {
    case hal::node::devices::WheelType::kOmni:
      return "omni";
    case hal::node::devices::WheelType::kMecanum:
      return "mecanum";
    case hal::node::devices::WheelType::kFixed:
      return "fixed";
    case hal::node::devices::WheelType::kCaster:
      return "caster";
  }
  return {};
}

Json box_json(const BodyBox& box) {
  return JsonObject()
      .add("x", box.centre.x)
      .add("y", box.centre.y)
      .add("z", box.centre.z)
      .add("length_x", box.size.x)
      .add("length_y", box.size.y)
      .add("length_z", box.size.z)
      .add("yaw", box.yaw)
      .json();
}

Json cylinder_json(const BodyCylinder& cylinder) {
  return JsonObject()
      .add("x", cylinder.centre.x)
      .add("y", cylinder.centre.y)
      .add("z", (cylinder.z_bottom + cylinder.z_top) / 2)
      .add("radius", cylinder.radius)
      .add("height", cylinder.z_top - cylinder.z_bottom)
      .json();
}

Json wheel_json(const Wheel& wheel) {
  return JsonObject()
      .add("x", wheel.position.x)
      .add("y", wheel.position.y)
      .add("heading", wheel.axle_heading)
      .add("radius", wheel.radius)
      .add("width", kDrawnWheelWidth * wheel.radius)
      .add("kind", name_of(wheel.type))
      .json();
}

template <class Range, class ToJson>
Json all_of(const Range& range, ToJson to_json) {
  JsonArray all;
  for (const auto& one : range) all.add(to_json(one));
  return all.json();
}

/// Radius of the circle around the origin that contains the body without its wheels; and its
/// height.
struct Hull {
  double radius = 0, height = 0;

  void add(double far, double top) {
    radius = std::max(radius, far);
    height = std::max(height, top);
  }
};

Hull hull_of(const RobotDescription& robot) {
  Hull hull;
  for (const BodyCylinder& one : robot.cylinders) {
    hull.add(std::hypot(one.centre.x, one.centre.y) + one.radius, one.z_top);
  }
  for (const BodyBox& one : robot.boxes) {
    hull.add(std::hypot(one.centre.x, one.centre.y) + std::hypot(one.size.x, one.size.y) / 2,
             one.centre.z + one.size.z / 2);
  }
  return hull;
}

Hull hull_of(const MoteDescription& mote) {
  Hull hull;
  hull.add(std::hypot(mote.size.x, mote.size.y) / 2, mote.size.z);
  return hull;
}

Hull hull_of(const sim::agents::Station&) { return {}; }

Json to_json(const std::string& model, const Hull& hull, const Json& cylinders, const Json& boxes,
             const Json& wheels) {
  return JsonObject()
      .add("model", model)
      .add("radius", hull.radius)
      .add("height", hull.height)
      .add("cylinders", cylinders)
      .add("boxes", boxes)
      .add("wheels", wheels)
      .json();
}

Json shape_of(const RobotDescription& robot) {
  return to_json(robot.model, hull_of(robot), all_of(robot.cylinders, cylinder_json),
                 all_of(robot.boxes, box_json), all_of(robot.wheels, wheel_json));
}

Json shape_of(const MoteDescription& mote) {
  const BodyBox box{.size = mote.size, .centre = {0, 0, mote.size.z / 2}};
  return to_json(mote.model, hull_of(mote), JsonArray().json(),
                 JsonArray().add(box_json(box)).json(), JsonArray().json());
}

Json shape_of(const sim::agents::Station&) { return {"null"}; }

}  // namespace

Json shape_json(const sim::agents::AgentConfig& agent) {
  return std::visit([](const auto& body) { return shape_of(body); }, agent.body);
}

double body_radius(const sim::agents::AgentConfig& agent) {
  return std::visit([](const auto& body) { return hull_of(body).radius; }, agent.body);
}

Json infrared_json(const sim::agents::AgentConfig& agent) {
  JsonArray sensors;
  if (const auto* robot = std::get_if<RobotDescription>(&agent.body)) {
    for (const auto& one : robot->infrared) {
      sensors.add(JsonObject()
                      .add("x", one.position.x)
                      .add("y", one.position.y)
                      .add("z", one.position.z)
                      .add("heading", one.heading)
                      .add("half_angle", one.half_angle)
                      .add("reach", one.curve.max_range())
                      .json());
    }
  }
  return sensors.json();
}

}  // namespace view::server
