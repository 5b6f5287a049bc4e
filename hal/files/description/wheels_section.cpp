#include "hal/files/description/wheels_section.h"

#include "hal/files/description/field_io.h"
#include "hal/files/description/infrared_section.h"

namespace hal::files::description {
namespace {

using node::devices::Wheel;
using node::devices::WheelType;

constexpr std::string_view kInWheelOrJoint =
    "that of `wheel`; there, it may be absent if all driven `joints` have it";

constexpr Range kWheelSize{1e-3, 10};   // m
constexpr Range kWheelMass{1e-3, 100};  // kg
constexpr Range kGrip{1e-3, 100};
constexpr Range kGlide{0, 100};
constexpr Range kRoller{-1.4, 1.4};  // rad: at 80 degrees a wheel hardly drives any more
constexpr double kGripOfDriven = 0.6;
constexpr double kGlideOfRollers = 0.02;
constexpr double kGlideOfCaster = 0.02;

constexpr std::array kTypes = {
    Option<WheelType>{"omni", WheelType::kOmni}, Option<WheelType>{"mecanum", WheelType::kMecanum},
    Option<WheelType>{"fixed", WheelType::kFixed}, Option<WheelType>{"caster", WheelType::kCaster}};

void size_keys(Fields& io, Wheel& c) {
  io.number({"radius", "Of the wheel.", "4 cm", kInWheelOrJoint}, "m", kWheelSize, c.radius);
  io.number({"mass", "Of the wheel.", "200 g", kInWheelOrJoint}, "kg", kWheelMass, c.mass);
}

void grip_key(Fields& io, Wheel& c) {
  io.number(
      {"mu",
       "Friction coefficient where the wheel grips: along its rolling direction, of a mecanum "
       "wheel along the axis of its rollers, of a caster along its axis.",
       "0.6", "0.6; of a caster 0.02"},
      "1", c.is_driven() ? kGrip : kGlide, c.mu);
}

void glide_key(Fields& io, Wheel& c) {
  io.number({"mu2", "Friction coefficient across that, where rollers give way.", "0.02",
             "0.02; of a fixed wheel and of a caster that of `mu`"},
            "1", kGlide, c.mu2);
}

void limit_keys(Fields& io, Wheel& c) {
  io.number({"effort", "Largest torque of the motor at the wheel.", "1 N m", kInWheelOrJoint},
            "N m", {1e-3, 1e4}, c.max_torque);
  io.number({"velocity", "Largest speed of the wheel.", "23.5 rad/s", kInWheelOrJoint}, "rad/s",
            {1e-3, 1e4}, c.max_speed);
  io.number({"stall_power",
             "What the motor takes from the battery at standstill with the full effort: all of it "
             "heats the winding.",
             "14 W"},
            "W", {0, 1e6}, c.stall_power);
}

const Key kRollerAngle{
    "roller_angle",
    "From the rolling direction, axis + 90 deg, to the axis of the roller on the ground, seen from "
    "above.",
    "-45 deg"};

void read_roller(Mapping& in, Wheel& wheel) {
  if (wheel.type != WheelType::kMecanum)
    return in.refuse(kRollerAngle.name, "only a mecanum wheel has one");
  wheel.roller_angle = in.number(kRollerAngle, "rad", kRoller);
}

/// @param glides  whether `mu2` was given for all wheels.
void read_friction(Fields& io, Wheel& wheel, bool glides) {
  grip_key(io, wheel);
  const bool has_rollers = wheel.type == WheelType::kOmni || wheel.type == WheelType::kMecanum;
  if (!glides) wheel.mu2 = has_rollers ? kGlideOfRollers : wheel.mu;
  glide_key(io, wheel);
}

void motor_keys(Fields& io, Wheel& wheel) {
  io.inside({"limit", "What the wheel's motor can do."},
            [&](Fields& limit) { limit_keys(limit, wheel); });
}

void read_driven(Mapping& in, Wheel& wheel, bool glides) {
  FieldReader reader(in);
  size_keys(reader, wheel);
  read_friction(reader, wheel, glides);
  motor_keys(reader, wheel);
}

Wheel read_caster(Mapping& in) {
  Wheel ball;
  ball.type = WheelType::kCaster;
  ball.mu = kGlideOfCaster;
  FieldReader reader(in);
  size_keys(reader, ball);
  for (const std::string key : {"radius", "mass"})
    if (!in.has(key)) in.mistake(key, "is missing: a caster takes nothing from wheel");
  read_friction(reader, ball, false);
  in.refuse("limit", "a caster has no motor");
  return ball;
}

/// Every key is given for all wheels or for this one.
void check_complete(Mapping& all, Mapping& joint) {
  const auto check = [](Mapping common, Mapping own, const std::string& key) {
    if (!common.has(key) && !own.has(key)) own.mistake(key, "is missing, here and in wheel");
  };
  check(all, joint, "radius");
  check(all, joint, "mass");
  check(all.within("limit"), joint.within("limit"), "effort");
  check(all.within("limit"), joint.within("limit"), "velocity");
}

WheelType read_common_type(Mapping& in) {
  static constexpr std::array kAlike{kTypes[0], kTypes[2]};
  return in.choice({"type",
                    "Of the `joints` that have none of their own; a mecanum wheel's stands beside "
                    "its `roller_angle`.",
                    "fixed"},
                   kAlike, WheelType::kOmni);
}

Wheel read_joint(Mapping& in, Mapping& all, const Wheel& common) {
  Wheel wheel = common;
  wheel.type = in.choice(
      {"type",
       "omni: rollers let it give way along its axle; mecanum: at `roller_angle` to it; fixed: an "
       "ordinary wheel; caster: a ball without a motor, which carries and goes anywhere.",
       "fixed", "that of `wheel`, which is omni if it has none"},
      kTypes, wheel.type);
  read_roller(in, wheel);
  if (wheel.is_driven()) {
    read_driven(in, wheel, all.has("mu2"));
    check_complete(all, in);
  } else {
    wheel = read_caster(in);
  }
  const Mounting mounting = read_mounting(
      in, {"axis", "Direction of the axle.", "60 deg", "the bearing of the position"});
  wheel.position = mounting.position;
  wheel.axle_heading = mounting.heading;
  return wheel;
}

void write_wheel(Fields& io, Wheel& wheel) {
  io.choice({"type", ""}, kTypes, wheel.type);
  io.vec2({"position", ""}, "m", kOffset, wheel.position);
  io.number({"axis", ""}, "rad", kAngle, wheel.axle_heading);
  size_keys(io, wheel);
  grip_key(io, wheel);
  glide_key(io, wheel);
  if (wheel.type == WheelType::kMecanum)
    io.number(kRollerAngle, "rad", kRoller, wheel.roller_angle);
  if (wheel.is_driven()) motor_keys(io, wheel);
}

}  // namespace

std::vector<Wheel> read_wheels(Mapping in) {
  Wheel common;
  common.mu = kGripOfDriven;
  Mapping all = in.mapping({"wheel", "What all driven wheels have in common."});
  common.type = read_common_type(all);
  read_driven(all, common, false);
  all.finish();
  std::vector<Wheel> wheels;
  for (Mapping& joint :
       in.mappings({"joints",
                    "The wheels, casters included, at least three, each where it is and how it "
                    "differs from `wheel`.",
                    "[{distance: 13 cm, bearing: 60 deg}, {distance: 13 cm, bearing: 180 deg}, "
                    "{distance: 13 cm, bearing: 300 deg}]",
                    config::kMustBeGiven})) {
    wheels.push_back(read_joint(joint, all, common));
    joint.finish();
  }
  if (wheels.size() < 3) in.mistake("joints", "must have at least three wheels");
  in.finish();
  return wheels;
}

void write_wheels(Writer& out, std::vector<Wheel> wheels) {
  FieldWriter(out).inside({"wheels", ""}, [&](Fields& io) {
    io.list<Wheel>({"joints", ""}, wheels, write_wheel);
  });
}

}  // namespace hal::files::description
