#pragma once

#include <cstdint>

#include "hal/types/geometry.h"

namespace hal::node::devices {

/// Which motions of the body a wheel permits at its contact point.
enum class WheelType : std::uint8_t {
  kOmni,     ///< Driven; 90 degree Swedish wheel: rollers let it slip along its axle.
  kMecanum,  ///< Driven; Swedish wheel whose rollers let it slip at an angle to its axle.
  kFixed,    ///< Driven; an ordinary wheel without rollers: it rolls or it slides.
  kCaster,   ///< Not driven: a ball that carries the body and rolls in any direction.
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
  double max_torque = 0;    ///< N m at the wheel, > 0; unused for a caster
  double max_speed = 0;     ///< rad/s, > 0; unused for a caster
  WheelType type = WheelType::kOmni;
  /// rad, -pi/2 .. pi/2 exclusive, counter-clockwise seen from above: for a mecanum wheel, from its
  /// rolling direction to the axis of the roller on the ground; 0 for all others.
  double roller_angle = 0;
  /// W, >= 0, that its motor consumes at standstill with max_torque, all of it heat in the winding.
  /// 0: the motor has no losses.
  double stall_power = 0;

  bool is_driven() const { return type != WheelType::kCaster; }

  /// Direction in which the rollers slip, rad, body frame; for an omni or a fixed wheel, that of
  /// the axle. The wheel has grip across it.
  double slip_heading() const { return axle_heading + roller_angle; }

  /// Heat [W] in the winding at a torque [N m]: R I^2, with the current proportional to the torque
  /// (A. Hughes, B. Drury, "Electric Motors and Drives", 5th ed., 2019, ch. 3: direct-current
  /// motors).
  double copper_loss(double torque) const {
    return stall_power * (torque / max_torque) * (torque / max_torque);
  }

  bool operator==(const Wheel&) const = default;
};

}  // namespace hal::node::devices
