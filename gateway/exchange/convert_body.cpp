#include "gateway/exchange/convert_body.h"

namespace gateway::exchange {
namespace {

wire::BodySolid to_wire(const hal::Solid& solid) {
  wire::BodySolid out;
  out.shape(static_cast<std::uint8_t>(solid.shape));
  out.size({solid.size.x, solid.size.y, solid.size.z});
  out.centre({solid.centre.x, solid.centre.y, solid.centre.z});
  out.yaw(solid.yaw);
  return out;
}

hal::Solid from_wire(const wire::BodySolid& solid, Ranges& ranges) {
  return {.shape = ranges.enumerator(solid.shape(), hal::Solid::Shape::kCylinder, "shape"),
          .size = {solid.size()[0], solid.size()[1], solid.size()[2]},
          .centre = {solid.centre()[0], solid.centre()[1], solid.centre()[2]},
          .yaw = solid.yaw()};
}

wire::BodyWheel to_wire(const hal::BodyWheel& wheel) {
  wire::BodyWheel out;
  out.is_driven(wheel.is_driven);
  out.position({wheel.position.x, wheel.position.y});
  out.axle_heading(wheel.axle_heading);
  out.roller_angle(wheel.roller_angle);
  out.radius(wheel.radius);
  out.max_speed(wheel.max_speed);
  out.max_torque(wheel.max_torque);
  return out;
}

hal::BodyWheel from_wire(const wire::BodyWheel& wheel) {
  return {.is_driven = wheel.is_driven(),
          .position = {wheel.position()[0], wheel.position()[1]},
          .axle_heading = wheel.axle_heading(),
          .roller_angle = wheel.roller_angle(),
          .radius = wheel.radius(),
          .max_speed = wheel.max_speed(),
          .max_torque = wheel.max_torque()};
}

}  // namespace

void put_body(const hal::RobotBody& body, wire::AgentSession& session) {
  session.model(body.model);
  for (const hal::Solid& solid : body.solids) session.solids().push_back(to_wire(solid));
  for (const hal::BodyWheel& wheel : body.wheels) session.wheels().push_back(to_wire(wheel));
}

hal::RobotBody body_from_wire(const wire::AgentSession& session, Ranges& ranges) {
  hal::RobotBody body{session.model(), {}, {}};
  for (const wire::BodySolid& solid : session.solids())
    body.solids.push_back(from_wire(solid, ranges));
  for (const wire::BodyWheel& wheel : session.wheels()) body.wheels.push_back(from_wire(wheel));
  return body;
}

}  // namespace gateway::exchange
