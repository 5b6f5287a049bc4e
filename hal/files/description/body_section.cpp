#include "hal/files/description/body_section.h"

#include <variant>
#include <vector>

#include "hal/files/description/field_io.h"
#include "hal/files/description/infrared_section.h"
#include "hal/files/description/rigid.h"
#include "hal/files/description/robot_checks.h"
#include "hal/files/description/sensors_section.h"
#include "hal/files/description/wheels_section.h"
#include "hal/types/overloaded.h"

namespace hal::files::description {
namespace {

using node::devices::AccelerationLimits;
using node::devices::BodyBox;
using node::devices::BodyCylinder;
using node::devices::BodyInertia;
using node::devices::MoteDescription;
using node::devices::RobotDescription;

const Key kCollision{
    "collision", "The solid shapes that make up the body, each upright; at least one.",
    "[{cylinder: {radius: 18 cm, bottom: 2 cm, top: 21 cm}, mass: 9 kg}]", config::kMustBeGiven};
const Key kShapeMass{"mass", "Mass of the shape, which is solid and has uniform density.", "9 kg"};

constexpr Range kSize{1e-3, 10};       // m
constexpr Range kHeight{0, 10};        // m, above the ground
constexpr Range kMass{1e-3, 1e4};      // kg
constexpr Range kMoteSize{1e-3, 1};    // m
constexpr Range kMoteMass{1e-3, 100};  // kg
constexpr Range kFriction{0, 100};
constexpr Range kAcceleration{1e-3, 1e3};

void acceleration_keys(Fields& io, AccelerationLimits& c) {
  io.number({"linear_up", "Largest rate at which the commanded speed may rise.", "0.8 m/s^2"},
            "m/s^2", kAcceleration, c.linear_up);
  io.number({"linear_down", "Largest rate at which the commanded speed may fall.", "1.5 m/s^2"},
            "m/s^2", kAcceleration, c.linear_down);
  io.number(
      {"angular_up", "Largest rate at which the commanded turning rate may rise.", "1.6 rad/s^2"},
      "rad/s^2", kAcceleration, c.angular_up);
  io.number({"angular_down", "Largest rate at which the commanded turning rate may fall.",
             "3.14 rad/s^2"},
            "rad/s^2", kAcceleration, c.angular_down);
}

void keys_of(Fields& io, BodyCylinder& c) {
  io.needed({"radius", "Radius of the cylinder.", "18 cm"}, "m", kSize, c.radius);
  io.needed({"bottom", "Height of its lower face above the ground.", "2 cm"}, "m", kHeight,
            c.z_bottom);
  io.needed({"top", "Height of its upper face, above `bottom`.", "21 cm"}, "m", kHeight, c.z_top);
  if (c.z_top <= c.z_bottom) io.mistake("top", "must be above bottom");
  io.vec2({"centre", "Centre of the cylinder in the body frame.", "[0 m, 0 m]"}, "m", kOffset,
          c.centre);
}

void keys_of(Fields& io, BodyBox& c) {
  io.needed({"size", "Lengths of the box's edges along its own axes.", "[20 cm, 10 cm, 5 cm]"}, "m",
            kSize, c.size);
  io.needed({"centre", "Centre of the box in the body frame, whose origin is on the ground.",
             "[5 cm, 0 m, 10 cm]"},
            "m", kOffset, c.centre);
  if (c.centre.z < c.size.z / 2) io.mistake("centre", "the box reaches into the ground");
  io.number({"yaw", "Rotation of the box about the vertical, counter-clockwise seen from above.",
             "45 deg"},
            "rad", kAngle, c.yaw);
}

using Shape = std::variant<std::monostate, BodyCylinder, BodyBox>;  ///< monostate: a mistake.

const std::array kShapes{alternative<Shape, BodyCylinder>({"cylinder", "An upright cylinder."}),
                         alternative<Shape, BodyBox>({"box", "A box."})};

/// @param has_mass  false: the body's `inertia` holds all masses, and that of a shape does not
/// count.
void shape_keys(Fields& io, Shape& shape, bool has_mass) {
  Mapping* const in = io.reading();
  const bool are_two = in != nullptr && in->has("cylinder") && in->has("box");
  const auto keys = [](Fields& one, Shape& any) {
    std::visit(Overloaded{[](std::monostate& /*c*/) {}, [&one](auto& c) { keys_of(one, c); }}, any);
  };
  if (are_two || !io.one_of(kShapes, shape, keys))
    io.mistake("", "must have either cylinder or box");
  double none = 0;
  const auto mass = Overloaded{[&none](std::monostate& /*c*/) -> double& { return none; },
                               [](auto& c) -> double& { return c.mass; }};
  if (has_mass) return io.needed(kShapeMass, "kg", kMass, std::visit(mass, shape));
  if (io.reading() != nullptr) io.reading()->has(kShapeMass.name);  // of an included file
}

/// Cylinders first, then boxes.
std::vector<Shape> shapes_of(const RobotDescription& robot) {
  std::vector<Shape> shapes(robot.cylinders.begin(), robot.cylinders.end());
  shapes.insert(shapes.end(), robot.boxes.begin(), robot.boxes.end());
  return shapes;
}

void collision_key(Fields& io, RobotDescription& robot) {
  std::vector<Shape> shapes = shapes_of(robot);
  const bool has_mass = !robot.inertia;
  io.list<Shape>(kCollision, shapes,
                 [&](Fields& one, Shape& shape) { shape_keys(one, shape, has_mass); });
  if (io.reading() == nullptr) return;
  for (const Shape& shape : shapes) {
    std::visit(Overloaded{[](std::monostate /*c*/) {},
                          [&](const BodyCylinder& c) { robot.cylinders.push_back(c); },
                          [&](const BodyBox& c) { robot.boxes.push_back(c); }},
               shape);
  }
  if (robot.cylinders.empty() && robot.boxes.empty())
    io.mistake(kCollision.name, "must have at least one shape");
}

/// Elements of the tensor are at most these of 10 t within 10 m.
constexpr Range kMoment{0, 1e6};      // kg m^2
constexpr Range kProduct{-1e6, 1e6};  // kg m^2

void keys_of(Fields& io, BodyInertia& c) {
  io.needed({"mass", "Mass of the body with its casters.", "1.2 kg"}, "kg", kMass, c.mass);
  io.needed({"centre", "Centre of mass in the body frame, whose origin is on the ground.",
             "[-3 cm, 0 m, 8 cm]"},
            "m", kOffset, c.centre);
  io.needed({"moments",
             "Moments of inertia about the axes of the body frame through the centre of mass: Ixx, "
             "Iyy, Izz.",
             "[0.002 kg m^2, 0.0021 kg m^2, 0.002 kg m^2]"},
            "kg m^2", kMoment, c.moments);
  io.vec3({"products",
           "The tensor's other elements: Ixy, Ixz, Iyz. Ixy is minus the integral of x y over the "
           "mass, as in URDF and SDF.",
           "[0 kg m^2, 0.0001 kg m^2, 0 kg m^2]"},
          "kg m^2", kProduct, c.products);
  if (io.reading() == nullptr || !io.reading()->has("moments")) return;
  if (const auto why = why_not_solid(c.moments, c.products)) io.mistake("moments", *why);
}

void link_keys(Fields& io, RobotDescription& robot) {
  BodyInertia inertia = robot.inertia.value_or(BodyInertia{});
  const bool has_inertia =
      io.inside_given({"inertia",
                       "Mass and inertia of the body with its casters, without its driven wheels; "
                       "masses of shapes and "
                       "casters do not count beside it. Absent: they make it."},
                      robot.inertia.has_value(), [&](Fields& own) { keys_of(own, inertia); });
  if (has_inertia) robot.inertia = inertia;
  io.number({"friction",
             "Coefficient of friction of the body's surface. Where two bodies touch, the lower "
             "coefficient of the two counts.",
             "0.3"},
            "1", kFriction, robot.friction);
  collision_key(io, robot);
}

}  // namespace

void keys_of(Fields& io, RobotDescription& robot) {
  version_key(io);
  io.needed_text({"model", "Name of the kind of robot.", "robertino"}, robot.model);
  io.inside({"link", "The body: its collision shapes with their masses, and its friction."},
            [&](Fields& link) { link_keys(link, robot); });
  io.inside({"wheels", "The wheels and casters on which the robot stands and drives."},
            [&](Fields& wheels) { wheels_keys(wheels, robot.wheels); });
  io.inside(
      {"acceleration", "Limits of the motor controller on changes of the commanded velocity."},
      [&](Fields& acceleration) { acceleration_keys(acceleration, robot.acceleration); });
  io.count({"encoder_steps", "Encoder steps per turn of a wheel; 0: unlimited resolution.", "4000"},
           0, 1'000'000, robot.encoder_steps);
  io.inside({"infrared", "Infrared range sensors around the body."},
            [&](Fields& infrared) { infrared_keys(infrared, robot.infrared); });
  sensor_keys(io, robot.sensors);
}

void keys_of(Fields& io, MoteDescription& c) {
  version_key(io);
  io.needed_text({"model", "Name of the kind of mote.", "mote"}, c.model);
  io.needed({"size", "Lengths of the edges of the mote, which is a box.", "[5 cm, 5 cm, 5 cm]"},
            "m", kMoteSize, c.size);
  io.number({"mass", "Mass of the mote.", "50 g"}, "kg", kMoteMass, c.mass);
  io.number({"friction",
             "Coefficient of friction of the mote's surface. Where two bodies touch, the lower "
             "coefficient of the two counts.",
             "0.6"},
            "1", kFriction, c.friction);
  sensor_keys(io, c.sensors);
}

RobotDescription read_robot(Mapping in, double gravity) {
  RobotDescription robot;
  FieldReader reader(in);
  keys_of(reader, robot);
  check_robot(in, robot, gravity);
  in.finish();
  return robot;
}

MoteDescription read_mote(Mapping in) {
  MoteDescription mote;
  FieldReader reader(in);
  keys_of(reader, mote);
  in.finish();
  return mote;
}

}  // namespace hal::files::description
