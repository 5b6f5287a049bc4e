#include "hal/description/body_section.h"

#include "hal/description/fields.h"
#include "hal/description/infrared_section.h"
#include "hal/description/robot_checks.h"
#include "hal/description/sensors_section.h"
#include "hal/description/wheels_section.h"
#include "hal/types/math.h"

namespace hal::description {
namespace {

using devices::AccelerationLimits;
using devices::BodyBox;
using devices::BodyCylinder;
using devices::MoteDescription;
using devices::RobotDescription;

const Key kVersion{"version", "Of the format of this file.", "1"};
const Key kShapeMass{"mass", "Of the shape, which is solid and homogeneous.", "9 kg"};

constexpr Range kSize{1e-3, 10};       // m
constexpr Range kHeight{0, 10};        // m, above the ground
constexpr Range kMass{1e-3, 1e4};      // kg
constexpr Range kMoteSize{1e-3, 1};    // m
constexpr Range kMoteMass{1e-3, 100};  // kg
constexpr Range kFriction{0, 100};
constexpr Range kAcceleration{1e-3, 1e3};

template <class Io>
void acceleration_keys(Io& io, AccelerationLimits& c) {
  io.number({"linear_up", "How fast the speed may grow.", "0.8 m/s^2"}, "m/s^2", kAcceleration,
            c.linear_up);
  io.number({"linear_down", "How fast the speed may fall.", "1.5 m/s^2"}, "m/s^2", kAcceleration,
            c.linear_down);
  io.number({"angular_up", "How fast the rate of turn may grow.", "1.6 rad/s^2"}, "rad/s^2",
            kAcceleration, c.angular_up);
  io.number({"angular_down", "How fast the rate of turn may fall.", "3.14 rad/s^2"}, "rad/s^2",
            kAcceleration, c.angular_down);
}

BodyCylinder read_cylinder(Mapping in, double mass) {
  BodyCylinder cylinder;
  cylinder.radius = in.number({"radius", "Of the cylinder.", "18 cm"}, "m", kSize);
  cylinder.z_bottom =
      in.number({"bottom", "Height of its lower face above the ground.", "2 cm"}, "m", kHeight);
  cylinder.z_top =
      in.number({"top", "Height of its upper face, above `bottom`.", "21 cm"}, "m", kHeight);
  if (cylinder.z_top <= cylinder.z_bottom) in.mistake("top", "must be above bottom");
  cylinder.centre = in.vec2(
      {"centre", "Of the cylinder, seen from the body's origin.", "[0 m, 0 m]"}, "m", kOffset, {});
  cylinder.mass = mass;
  in.finish();
  return cylinder;
}

BodyBox read_box(Mapping in, double mass) {
  BodyBox box;
  box.size =
      in.vec3({"size", "Of the box along its own axes.", "[20 cm, 10 cm, 5 cm]"}, "m", kSize);
  box.centre = in.vec3(
      {"centre", "Of the box, seen from the body's origin on the ground.", "[5 cm, 0 m, 10 cm]"},
      "m", kOffset);
  if (box.centre.z < box.size.z / 2) in.mistake("centre", "the box reaches into the ground");
  box.yaw = in.number({"yaw", "By which the box is turned, seen from above.", "45 deg"}, "rad",
                      kAngle, 0);
  box.mass = mass;
  in.finish();
  return box;
}

void read_link(Mapping in, RobotDescription& robot) {
  robot.friction = in.number(
      {"friction", "Coefficient of the body against walls, motes and other robots.", "0.3"}, "1",
      kFriction, robot.friction);
  for (Mapping& shape :
       in.mappings({"collision", "Upright, solid shapes that make the body; at least one.",
                    "[{cylinder: {radius: 18 cm, bottom: 2 cm, top: 21 cm}, mass: 9 kg}]",
                    config::kMustBeGiven})) {
    const double mass = shape.number(kShapeMass, "kg", kMass);
    const bool cylinder = shape.has("cylinder");
    if (cylinder == shape.has("box")) {
      shape.mistake("", "must have either cylinder or box");
    } else if (cylinder) {
      robot.cylinders.push_back(
          read_cylinder(shape.mapping({"cylinder", "An upright cylinder."}), mass));
    } else {
      robot.boxes.push_back(read_box(shape.mapping({"box", "A box."}), mass));
    }
    shape.finish();
  }
  if (robot.cylinders.empty() && robot.boxes.empty()) {
    in.mistake("collision", "must have at least one shape");
  }
  in.finish();
}

void write_link(Writer& out, const RobotDescription& robot) {
  out.open("link");
  out.number("friction", robot.friction, "1");
  out.open_list("collision");
  for (const BodyCylinder& cylinder : robot.cylinders) {
    out.open_item();
    out.open("cylinder");
    out.number("radius", cylinder.radius, "m");
    out.number("bottom", cylinder.z_bottom, "m");
    out.number("top", cylinder.z_top, "m");
    out.numbers("centre", {cylinder.centre.x, cylinder.centre.y}, "m");
    out.close();
    out.number("mass", cylinder.mass, "kg");
    out.close();
  }
  for (const BodyBox& box : robot.boxes) {
    out.open_item();
    out.open("box");
    out.numbers("size", {box.size.x, box.size.y, box.size.z}, "m");
    out.numbers("centre", {box.centre.x, box.centre.y, box.centre.z}, "m");
    out.number("yaw", box.yaw, "rad");
    out.close();
    out.number("mass", box.mass, "kg");
    out.close();
  }
  out.close();
  out.close();
}

template <class Io>
void mote_keys(Io& io, MoteDescription& c) {
  io.number({"mass", "Of the mote.", "50 g"}, "kg", kMoteMass, c.mass);
  io.number({"friction", "Coefficient against everything.", "0.6"}, "1", kFriction, c.friction);
}

}  // namespace

RobotDescription read_robot(Mapping in, double gravity) {
  RobotDescription robot;
  in.integer(kVersion, 1, 1, 1);
  robot.model = in.text({"model", "Name of the kind of robot.", "robertino"});
  read_link(in.mapping({"link", "The body: shapes that touch things, and their mass."}), robot);
  robot.wheels = read_wheels(in.mapping({"wheels", "What the robot stands and drives on."}));
  Mapping acceleration = in.mapping(
      {"acceleration", "How fast the motor controller lets a commanded velocity change."});
  FieldReader reader(acceleration);
  acceleration_keys(reader, robot.acceleration);
  acceleration.finish();
  robot.encoder_steps = static_cast<int>(in.integer(
      {"encoder_steps", "Steps of the encoder per turn of a wheel; 0: continuous.", "4000"}, 0,
      1'000'000, 0));
  robot.infrared = read_infrared(in.mapping({"infrared", "Infrared rangers around the body."}));
  robot.sensors = read_sensors(in);
  check_robot(in, robot, gravity);
  in.finish();
  return robot;
}

void write_robot(Writer& out, const RobotDescription& robot) {
  AccelerationLimits acceleration = robot.acceleration;
  FieldWriter writer(out);
  out.open("robot");
  out.text("model", robot.model);
  write_link(out, robot);
  write_wheels(out, robot.wheels);
  out.open("acceleration");
  acceleration_keys(writer, acceleration);
  out.close();
  out.integer("encoder_steps", robot.encoder_steps);
  write_infrared(out, robot.infrared);
  write_sensors(out, robot.sensors);
  out.close();
}

MoteDescription read_mote(Mapping in) {
  MoteDescription mote;
  in.integer(kVersion, 1, 1, 1);
  mote.model = in.text({"model", "Name of the kind of mote.", "mote"});
  mote.size =
      in.vec3({"size", "Of the box that the mote is.", "[5 cm, 5 cm, 5 cm]"}, "m", kMoteSize);
  FieldReader reader(in);
  mote_keys(reader, mote);
  mote.sensors = read_sensors(in);
  in.finish();
  return mote;
}

void write_mote(Writer& out, const MoteDescription& mote) {
  MoteDescription copy = mote;
  FieldWriter writer(out);
  out.open("mote");
  out.text("model", mote.model);
  out.numbers("size", {mote.size.x, mote.size.y, mote.size.z}, "m");
  mote_keys(writer, copy);
  write_sensors(out, mote.sensors);
  out.close();
}

}  // namespace hal::description
