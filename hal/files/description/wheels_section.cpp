#include "hal/files/description/wheels_section.h"

#include "hal/files/description/mounting.h"

namespace hal::files::description {
namespace {

using node::devices::Wheel;
using node::devices::WheelType;

constexpr std::string_view kInWheelOrJoint =
    "that of `wheel`, where it may be absent if all driven `joints` give it";

constexpr Range kWheelSize{1e-3, 10};   // m
constexpr Range kWheelMass{1e-3, 100};  // kg
constexpr Range kGrip{1e-3, 100};
constexpr Range kGlide{0, 100};
constexpr Range kRoller{-1.4, 1.4};  // rad: at 80 degrees a wheel hardly drives
constexpr double kGripOfDriven = 0.6;
constexpr double kGlideOfRollers = 0.02;
constexpr double kGlideOfCaster = 0.02;

constexpr std::array kTypes = {
    Option<WheelType>{"omni", WheelType::kOmni}, Option<WheelType>{"mecanum", WheelType::kMecanum},
    Option<WheelType>{"fixed", WheelType::kFixed}, Option<WheelType>{"caster", WheelType::kCaster}};

void size_keys(Fields& io, Wheel& c) {
  io.number({"radius", "Radius of the wheel.", "4 cm", kInWheelOrJoint}, "m", kWheelSize, c.radius);
  io.number({"mass", "Mass of the wheel.", "200 g", kInWheelOrJoint}, "kg", kWheelMass, c.mass);
}

void grip_key(Fields& io, Wheel& c) {
  io.number({"mu",
             "Coefficient of friction in the direction in which the wheel grips: its rolling "
             "direction; for a mecanum wheel, the axis of its rollers; for a caster, its axis.",
             "0.6", "0.6; 0.02 for a caster"},
            "1", c.is_driven() ? kGrip : kGlide, c.mu);
}

void glide_key(Fields& io, Wheel& c) {
  io.number({"mu2", "Coefficient of friction at right angles to that, where rollers give way.",
             "0.02", "0.02; that of `mu` for fixed wheels and casters"},
            "1", kGlide, c.mu2);
}

void limit_keys(Fields& io, Wheel& c) {
  io.number({"effort", "Largest torque of the motor at the wheel.", "1 N m", kInWheelOrJoint},
            "N m", {1e-3, 1e4}, c.max_torque);
  io.number({"velocity", "Largest angular speed of the wheel.", "23.5 rad/s", kInWheelOrJoint},
            "rad/s", {1e-3, 1e4}, c.max_speed);
  io.number({"stall_power",
             "Power that the motor draws from the battery at standstill with full torque; all of "
             "it heats the winding.",
             "14 W"},
            "W", {0, 1e6}, c.stall_power);
}

const Key kRollerAngle{"roller_angle",
                       "Angle from the rolling direction (axis + 90 deg) to the axis of the roller "
                       "that touches the ground, seen from above.",
                       "-45 deg"};

/// @param glides  whether `mu2` is given for all wheels.
void friction_keys(Fields& io, Wheel& c, bool glides) {
  grip_key(io, c);
  const bool has_rollers = c.type == WheelType::kOmni || c.type == WheelType::kMecanum;
  if (!io.is_writing() && !glides) c.mu2 = has_rollers ? kGlideOfRollers : c.mu;
  glide_key(io, c);
}

void motor_keys(Fields& io, Wheel& c) {
  io.inside({"limit", "Limits of the wheel's motor."},
            [&](Fields& limit) { limit_keys(limit, c); });
}

/// Properties common to all driven wheels.
void common_keys(Fields& io, Wheel& c) {
  static constexpr std::array kAlike{kTypes[0], kTypes[2]};
  io.choice({"type",
             "Type of the `joints` that give none. A mecanum wheel gives it in `joints`, beside "
             "its `roller_angle`.",
             "fixed"},
            kAlike, c.type);
  size_keys(io, c);
  friction_keys(io, c, false);
  motor_keys(io, c);
}

/// A caster must have its own values; a driven wheel may take them from `wheel`.
void check_complete(Mapping joint, Mapping all, bool is_driven) {
  const auto check = [&](Mapping common, Mapping own, const std::string& key) {
    if (own.has(key)) return;
    if (!is_driven) own.mistake(key, "is missing: a caster takes nothing from wheel");
    if (is_driven && !common.has(key)) own.mistake(key, "is missing, here and in wheel");
  };
  check(all, joint, "radius");
  check(all, joint, "mass");
  if (!is_driven) return;
  check(all.within("limit"), joint.within("limit"), "effort");
  check(all.within("limit"), joint.within("limit"), "velocity");
}

/// Keys of a driven wheel or of a caster.
void drive_keys(Fields& io, Wheel& c, bool glides) {
  size_keys(io, c);
  friction_keys(io, c, glides && c.is_driven());
  if (c.type == WheelType::kMecanum) {
    io.needed(kRollerAngle, "rad", kRoller, c.roller_angle);
  } else {
    io.unused(kRollerAngle.name, "only a mecanum wheel has one");
  }
  if (c.is_driven()) return motor_keys(io, c);
  io.unused("limit", "a caster has no motor");
}

/// A caster at the same place; it takes nothing from `wheel`.
Wheel caster_at(const Wheel& place) {
  return {.position = place.position,
          .axle_heading = place.axle_heading,
          .mu = kGlideOfCaster,
          .type = WheelType::kCaster};
}

/// @param all  the mapping of the robot's wheels when reading; otherwise null.
void joint_keys(Fields& io, Wheel& c, Mapping* all) {
  mounting_keys(
      io,
      {"axis", "Direction of the axle in the body frame.", "60 deg", "the bearing of the position"},
      c.position, c.axle_heading);
  const bool glides = all != nullptr && all->within("wheel").has("mu2");
  const auto keys = [&](Fields& one) {
    if (!one.is_writing() && !c.is_driven()) c = caster_at(c);
    drive_keys(one, c, glides);
  };
  io.choice({"type",
             "omni: rollers let the wheel slip along its axle; mecanum: rollers at `roller_angle`; "
             "fixed: an ordinary wheel; caster: a ball without a motor, which supports the robot "
             "and rolls in every direction.",
             "fixed", "that of `wheel`, which is omni by default"},
            kTypes, c.type, keys);
  if (all != nullptr) check_complete(*io.reading(), all->within("wheel"), c.is_driven());
}

}  // namespace

void wheels_keys(Fields& io, std::vector<Wheel>& wheels) {
  Wheel common;
  common.mu = kGripOfDriven;
  io.written_if(false, [&](Fields& read) {
    read.inside({"wheel", "Properties that all driven wheels share."},
                [&](Fields& all) { common_keys(all, common); });
  });
  io.list<Wheel>(
      {"joints",
       "The wheels and casters, at least three: the position of each, and the properties in which "
       "it differs from `wheel`.",
       "[{distance: 13 cm, bearing: 60 deg}, {distance: 13 cm, bearing: 180 deg}, {distance: 13 "
       "cm, bearing: 300 deg}]",
       config::kMustBeGiven},
      wheels, [&](Fields& one, Wheel& wheel) { joint_keys(one, wheel, io.reading()); }, common);
  if (wheels.size() < 3) io.mistake("joints", "must have at least three wheels");
}

}  // namespace hal::files::description
