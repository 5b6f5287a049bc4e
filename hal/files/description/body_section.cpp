#include "hal/files/description/body_section.h"

#include "hal/files/description/field_io.h"
#include "hal/files/description/infrared_section.h"
#include "hal/files/description/robot_checks.h"
#include "hal/files/description/sensors_section.h"
#include "hal/files/description/wheels_section.h"
#include "hal/types/math.h"

namespace hal::files::description {
namespace {

using node::devices::AccelerationLimits;
using node::devices::BodyBox;
using node::devices::BodyCylinder;
using node::devices::MoteDescription;
using node::devices::RobotDescription;

const Key kCollision{"collision", "Upright, solid shapes that make the body; at least one.",
                     "[{cylinder: {radius: 18 cm, bottom: 2 cm, top: 21 cm}, mass: 9 kg}]",
                     config::kMustBeGiven};
const Key kShapeMass{"mass", "Of the shape, which is solid and homogeneous.", "9 kg"};

constexpr Range kSize{1e-3, 10};       // m
constexpr Range kHeight{0, 10};        // m, above the ground
constexpr Range kMass{1e-3, 1e4};      // kg
constexpr Range kMoteSize{1e-3, 1};    // m
constexpr Range kMoteMass{1e-3, 100};  // kg
constexpr Range kFriction{0, 100};
constexpr Range kAcceleration{1e-3, 1e3};

void acceleration_keys(Fields& io, AccelerationLimits& c) {
  io.number({"linear_up", "How fast the speed may grow.", "0.8 m/s^2"}, "m/s^2", kAcceleration,
            c.linear_up);
  io.number({"linear_down", "How fast the speed may fall.", "1.5 m/s^2"}, "m/s^2", kAcceleration,
            c.linear_down);
  io.number({"angular_up", "How fast the rate of turn may grow.", "1.6 rad/s^2"}, "rad/s^2",
            kAcceleration, c.angular_up);
  io.number({"angular_down", "How fast the rate of turn may fall.", "3.14 rad/s^2"}, "rad/s^2",
            kAcceleration, c.angular_down);
}

void keys_of(Fields& io, BodyCylinder& c) {
  io.needed({"radius", "Of the cylinder.", "18 cm"}, "m", kSize, c.radius);
  io.needed({"bottom", "Height of its lower face above the ground.", "2 cm"}, "m", kHeight,
            c.z_bottom);
  io.needed({"top", "Height of its upper face, above `bottom`.", "21 cm"}, "m", kHeight, c.z_top);
  if (c.z_top <= c.z_bottom) io.mistake("top", "must be above bottom");
  io.vec2({"centre", "Of the cylinder, seen from the body's origin.", "[0 m, 0 m]"}, "m", kOffset,
          c.centre);
}

void keys_of(Fields& io, BodyBox& c) {
  io.needed({"size", "Of the box along its own axes.", "[20 cm, 10 cm, 5 cm]"}, "m", kSize, c.size);
  io.needed(
      {"centre", "Of the box, seen from the body's origin on the ground.", "[5 cm, 0 m, 10 cm]"},
      "m", kOffset, c.centre);
  if (c.centre.z < c.size.z / 2) io.mistake("centre", "the box reaches into the ground");
  io.number({"yaw", "By which the box is turned, seen from above.", "45 deg"}, "rad", kAngle,
            c.yaw);
}

void keys_of_cylinder(Fields& io, BodyCylinder& cylinder) {
  io.inside({"cylinder", "An upright cylinder."}, [&](Fields& in) { keys_of(in, cylinder); });
}

void keys_of_box(Fields& io, BodyBox& box) {
  io.inside({"box", "A box."}, [&](Fields& in) { keys_of(in, box); });
}

void read_shapes(Mapping& in, RobotDescription& robot) {
  for (Mapping& shape : in.mappings(kCollision)) {
    FieldReader reader(shape);
    double mass = 0;
    reader.needed(kShapeMass, "kg", kMass, mass);
    const bool cylinder = shape.has("cylinder");
    if (cylinder == shape.has("box")) {
      shape.mistake("", "must have either cylinder or box");
    } else if (cylinder) {
      keys_of_cylinder(reader, robot.cylinders.emplace_back());
      robot.cylinders.back().mass = mass;
    } else {
      keys_of_box(reader, robot.boxes.emplace_back());
      robot.boxes.back().mass = mass;
    }
    shape.finish();
  }
  if (robot.cylinders.empty() && robot.boxes.empty()) {
    in.mistake(kCollision.name, "must have at least one shape");
  }
}

void write_shapes(Writer& out, RobotDescription& robot) {
  FieldWriter writer(out);
  out.open_list(kCollision.name);
  for (BodyCylinder& cylinder : robot.cylinders) {
    out.open_item();
    keys_of_cylinder(writer, cylinder);
    writer.needed(kShapeMass, "kg", kMass, cylinder.mass);
    out.close();
  }
  for (BodyBox& box : robot.boxes) {
    out.open_item();
    keys_of_box(writer, box);
    writer.needed(kShapeMass, "kg", kMass, box.mass);
    out.close();
  }
  out.close();
}

void link_keys(Fields& io, RobotDescription& robot) {
  io.number({"friction", "Coefficient of the body against walls, motes and other robots.", "0.3"},
            "1", kFriction, robot.friction);
  io.own(
      kCollision, [&](Mapping& in) { read_shapes(in, robot); },
      [&](Writer& out) { write_shapes(out, robot); });
}

}  // namespace

void keys_of(Fields& io, RobotDescription& robot) {
  version_key(io);
  io.needed_text({"model", "Name of the kind of robot.", "robertino"}, robot.model);
  io.inside({"link", "The body: shapes that touch things, and their mass."},
            [&](Fields& link) { link_keys(link, robot); });
  io.own(
      {"wheels", "What the robot stands and drives on."},
      [&](Mapping& in) {
        robot.wheels = read_wheels(in.mapping({"wheels", "What the robot stands and drives on."}));
      },
      [&](Writer& out) { write_wheels(out, robot.wheels); });
  io.inside({"acceleration", "How fast the motor controller lets a commanded velocity change."},
            [&](Fields& acceleration) { acceleration_keys(acceleration, robot.acceleration); });
  io.count({"encoder_steps", "Steps of the encoder per turn of a wheel; 0: continuous.", "4000"}, 0,
           1'000'000, robot.encoder_steps);
  io.own(
      {"infrared", "Infrared rangers around the body."},
      [&](Mapping& in) {
        robot.infrared =
            read_infrared(in.mapping({"infrared", "Infrared rangers around the body."}));
      },
      [&](Writer& out) { write_infrared(out, robot.infrared); });
  sensor_keys(io, robot.sensors);
}

void keys_of(Fields& io, MoteDescription& c) {
  version_key(io);
  io.needed_text({"model", "Name of the kind of mote.", "mote"}, c.model);
  io.needed({"size", "Of the box that the mote is.", "[5 cm, 5 cm, 5 cm]"}, "m", kMoteSize, c.size);
  io.number({"mass", "Of the mote.", "50 g"}, "kg", kMoteMass, c.mass);
  io.number({"friction", "Coefficient against everything.", "0.6"}, "1", kFriction, c.friction);
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
