#include "hal/description/body_section.h"

#include "hal/description/fields.h"
#include "hal/description/infrared_section.h"
#include "hal/description/robot_checks.h"
#include "hal/types/math.h"

namespace hal::description {
namespace {

using devices::AccelerationLimits;
using devices::BodyBox;
using devices::BodyCylinder;
using devices::MoteDescription;
using devices::RobotDescription;
using devices::Wheel;

constexpr Range kSize{1e-3, 10};   // m
constexpr Range kHeight{0, 10};    // m, above the ground
constexpr Range kMass{1e-3, 1e4};  // kg
constexpr Range kFriction{0, 100};
constexpr Range kAcceleration{1e-3, 1e3};

template <class Io>
void acceleration_keys(Io& io, AccelerationLimits& c) {
  io.number("linear_up", "m/s^2", kAcceleration, c.linear_up);
  io.number("linear_down", "m/s^2", kAcceleration, c.linear_down);
  io.number("angular_up", "rad/s^2", kAcceleration, c.angular_up);
  io.number("angular_down", "rad/s^2", kAcceleration, c.angular_down);
}

BodyCylinder read_cylinder(Mapping& shape, Mapping in) {
  BodyCylinder cylinder;
  cylinder.radius = in.number("radius", "m", kSize);
  cylinder.z_bottom = in.number("bottom", "m", kHeight);
  cylinder.z_top = in.number("top", "m", kHeight);
  if (cylinder.z_top <= cylinder.z_bottom) in.mistake("top", "must be above bottom");
  cylinder.centre = in.vec2("centre", "m", kOffset, {});
  cylinder.mass = shape.number("mass", "kg", kMass);
  in.finish();
  return cylinder;
}

BodyBox read_box(Mapping& shape, Mapping in) {
  BodyBox box;
  box.size = in.vec3("size", "m", kSize);
  box.centre = in.vec3("centre", "m", kOffset);
  if (box.centre.z < box.size.z / 2) in.mistake("centre", "the box reaches into the ground");
  box.yaw = in.number("yaw", "rad", kAngle, 0);
  box.mass = shape.number("mass", "kg", kMass);
  in.finish();
  return box;
}

void read_link(Mapping in, RobotDescription& robot) {
  robot.friction = in.number("friction", "1", kFriction, robot.friction);
  for (Mapping& shape : in.mappings("collision")) {
    const bool cylinder = shape.has("cylinder");
    if (cylinder == shape.has("box")) {
      shape.mistake("", "must have either cylinder or box");
      shape.has("mass");
    } else if (cylinder) {
      robot.cylinders.push_back(read_cylinder(shape, shape.mapping("cylinder")));
    } else {
      robot.boxes.push_back(read_box(shape, shape.mapping("box")));
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

/// Common to all wheels; a joint may deviate.
template <class Io>
void wheel_keys(Io& io, Wheel& c) {
  io.number("radius", "m", kSize, c.radius);
  io.number("mass", "kg", kMass, c.mass);
  io.number("mu", "1", {1e-3, 100}, c.mu);
  io.number("mu2", "1", kFriction, c.mu2);
}

template <class Io>
void limit_keys(Io& io, Wheel& c) {
  io.number("effort", "N m", {1e-3, 1e4}, c.max_torque);
  io.number("velocity", "rad/s", {1e-3, 1e4}, c.max_speed);
}

void read_wheel(Mapping& in, Wheel& wheel) {
  FieldReader reader(in);
  wheel_keys(reader, wheel);
  Mapping limit = in.mapping("limit");
  FieldReader limit_reader(limit);
  limit_keys(limit_reader, wheel);
  limit.finish();
}

/// Every key is given for all wheels or for this one.
void check_complete(Mapping& all, Mapping& joint) {
  const auto check = [](Mapping common, Mapping own, const std::string& key) {
    if (!common.has(key) && !own.has(key)) own.mistake(key, "is missing");
  };
  check(all, joint, "radius");
  check(all, joint, "mass");
  check(all.mapping("limit"), joint.mapping("limit"), "effort");
  check(all.mapping("limit"), joint.mapping("limit"), "velocity");
}

void read_wheels(Mapping in, RobotDescription& robot) {
  Wheel common;
  Mapping all = in.mapping("wheel");
  read_wheel(all, common);
  all.finish();
  for (Mapping& joint : in.mappings("joints")) {
    Wheel wheel = common;
    read_wheel(joint, wheel);
    check_complete(all, joint);
    const Mounting mounting = read_mounting(joint, "axis");
    wheel.position = mounting.position;
    wheel.axle_heading = mounting.heading;
    robot.wheels.push_back(wheel);
    joint.finish();
  }
  if (robot.wheels.size() < 3) in.mistake("joints", "must have at least three wheels");
  in.finish();
}

void write_wheels(Writer& out, const RobotDescription& robot) {
  FieldWriter writer(out);
  out.open("wheels");
  out.open_list("joints");
  for (Wheel wheel : robot.wheels) {
    out.open_item();
    out.numbers("position", {wheel.position.x, wheel.position.y}, "m");
    out.number("axis", wheel.axle_heading, "rad");
    wheel_keys(writer, wheel);
    out.open("limit");
    limit_keys(writer, wheel);
    out.close();
    out.close();
  }
  out.close();
  out.close();
}

template <class Io>
void mote_keys(Io& io, MoteDescription& c) {
  io.number("mass", "kg", kMass, c.mass);
  io.number("friction", "1", kFriction, c.friction);
}

}  // namespace

RobotDescription read_robot(Mapping in) {
  RobotDescription robot;
  in.integer("version", 1, 1, 1);
  robot.model = in.text("model");
  read_link(in.mapping("link"), robot);
  read_wheels(in.mapping("wheels"), robot);
  Mapping acceleration = in.mapping("acceleration");
  FieldReader reader(acceleration);
  acceleration_keys(reader, robot.acceleration);
  acceleration.finish();
  robot.encoder_steps = static_cast<int>(in.integer("encoder_steps", 0, 1'000'000, 0));
  robot.infrared = read_infrared(in.mapping("infrared"));
  check_robot(in, robot);
  in.finish();
  return robot;
}

void write_robot(Writer& out, const RobotDescription& robot) {
  AccelerationLimits acceleration = robot.acceleration;
  FieldWriter writer(out);
  out.open("robot");
  out.text("model", robot.model);
  write_link(out, robot);
  write_wheels(out, robot);
  out.open("acceleration");
  acceleration_keys(writer, acceleration);
  out.close();
  out.integer("encoder_steps", robot.encoder_steps);
  write_infrared(out, robot.infrared);
  out.close();
}

MoteDescription read_mote(Mapping in) {
  MoteDescription mote;
  in.integer("version", 1, 1, 1);
  mote.model = in.text("model");
  mote.size = in.vec3("size", "m", kSize);
  FieldReader reader(in);
  mote_keys(reader, mote);
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
  out.close();
}

}  // namespace hal::description
