#pragma once

#include <cstdint>

#include "hal/types/geometry.h"

namespace hal::node::devices {

/// What a wheel lets the body do where it stands on the ground.
enum class WheelType : std::uint8_t {
  kOmni,     ///< Driven; 90 degree Swedish wheel: rollers let it give way along its axle.
  kMecanum,  ///< Driven; Swedish wheel whose rollers let it give way at an angle to its axle.
  kFixed,    ///< Driven; an ordinary wheel, which does not give way: it rolls or it slips.
  kCaster,   ///< Not driven: a ball that carries the body and lets it go anywhere.
};

/// A wheel, driven by a motor with a velocity servo unless it is a caster. A positive speed drives
/// the robot's body, at the wheel, towards axle_heading + 90 degrees: with axles that point outward
/// all wheels at equal speed turn the robot counter-clockwise.
struct Wheel {
  Vec2 position;            ///< m, centre of the wheel
  double axle_heading = 0;  ///< rad, direction of the axle in the body frame
  double radius = 0;        ///< m, > 0
  double mass = 0;          ///< kg, > 0
  double mu = 0.6;          ///< friction across slip_heading(), > 0; of a caster >= 0
  double mu2 = 0.02;        ///< friction along slip_heading(), >= 0
  double max_torque = 0;    ///< N m at the wheel, > 0; of a caster unused, as is
  double max_speed = 0;     ///< rad/s, > 0
  WheelType type = WheelType::kOmni;
  /// rad, -pi/2 .. pi/2 exclusive, counter-clockwise from above: of a mecanum wheel, from its
  /// rolling direction to the axis of the roller on the ground; of all others 0.
  double roller_angle = 0;
  /// W, >= 0, that its motor takes in at standstill with max_torque: all of it heats the winding.
  /// 0: the motor has no losses.
  double stall_power = 0;

  bool is_driven() const { return type != WheelType::kCaster; }

  /// rad, body frame: the direction in which the rollers give way, or would: the axle of an omni or
  /// a fixed wheel. Across it the wheel grips.
  double slip_heading() const { return axle_heading + roller_angle; }

  /// W of heat in the winding at a torque [N m]: R I^2, and the current goes with the torque
  /// (A. Hughes, B. Drury, "Electric Motors and Drives", 5th ed., 2019, ch. 3: direct-current
  /// motors).
  double copper_loss(double torque) const {
    return stall_power * (torque / max_torque) * (torque / max_torque);
  }

  bool operator==(const Wheel&) const = default;
};

}  // namespace hal::node::devices
