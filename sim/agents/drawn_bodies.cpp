#include "sim/agents/drawn_bodies.h"

#include <algorithm>
#include <variant>

#include "hal/node/devices/robot_outline.h"

namespace sim::agents {
namespace {

using hal::Solid;
using hal::node::devices::MoteDescription;
using hal::node::devices::RobotDescription;

constexpr double kStationRadius = 0.1;                     // m
constexpr double kArrowWidth = 0.04, kArrowHeight = 0.02;  // m

/// An arrow from the middle of the body forward, above all its shapes.
Solid arrow_of(const RobotDescription& robot) {
  double top = 0, reach = 0;
  for (const auto& part : robot.cylinders) {
    top = std::max(top, part.z_top);
    reach = std::max(reach, part.centre.x + part.radius);
  }
  for (const auto& part : robot.boxes) {
    top = std::max(top, part.centre.z + part.size.z / 2);
    reach = std::max(reach, part.centre.x + part.size.x / 2);
  }
  return {.shape = Solid::Shape::kArrow,
          .size = {reach, kArrowWidth, kArrowHeight},
          .centre = {0, 0, top + kArrowHeight}};
}

struct SolidsOf {
  hal::DrawnBody operator()(const MoteDescription& mote) const {
    return {"", hal::DrawnAs::kMote, {{.size = mote.size, .centre = {0, 0, mote.size.z / 2}}}};
  }
  hal::DrawnBody operator()(const RobotDescription& robot) const {
    hal::DrawnBody drawn{"", hal::DrawnAs::kRobot, hal::node::devices::body_of(robot).solids};
    drawn.solids.push_back(arrow_of(robot));
    return drawn;
  }
  hal::DrawnBody operator()(const Station&) const {
    constexpr double kDiameter = 2 * kStationRadius;
    return {"",
            hal::DrawnAs::kStation,
            {{.shape = Solid::Shape::kSphere,
              .size = {kDiameter, kDiameter, kDiameter},
              .centre = {0, 0, kStationRadius}}}};
  }
};

}  // namespace

hal::DrawnBody drawn_body(const AgentConfig& agent) {
  hal::DrawnBody drawn = std::visit(SolidsOf{}, agent.body);
  drawn.name = agent.name;
  return drawn;
}

hal::DrawnBody drawn_body(const physics::StaticBox& wall) {
  return {wall.name,
          hal::DrawnAs::kWall,
          {{.size = wall.size, .centre = wall.centre, .yaw = wall.yaw}}};
}

bool stands_on(const Ground& ground, const physics::StaticBox& wall) {
  constexpr double kSunk = 1e-6;  // m, by rounding
  const double above = wall.centre.z - ground.height({wall.centre.x, wall.centre.y});
  return above - wall.size.z / 2 <= kSunk && above + wall.size.z / 2 > 0;
}

}  // namespace sim::agents
