#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/node/devices/infrared_curve.h"
#include "hal/node/devices/sensors.h"
#include "hal/node/devices/wheel.h"
#include "hal/types/geometry.h"
#include "hal/types/time.h"

namespace hal::node::devices {

/// The contents of a robot file: a new wheeled robot needs a file but no C++. Body frame: origin on
/// the ground below the middle of the wheels, x forward, y left, z up. SI units.

/// Upright cylinder fixed to the body, solid and homogeneous.
struct BodyCylinder {
  double radius = 0;    ///< m, > 0
  double z_bottom = 0;  ///< m, >= 0
  double z_top = 0;     ///< m, > z_bottom
  Vec2 centre;          ///< m
  double mass = 0;      ///< kg, > 0
  bool operator==(const BodyCylinder&) const = default;
};

/// Upright box fixed to the body, solid and homogeneous.
struct BodyBox {
  Vec3 size;        ///< m, along its own axes, each > 0
  Vec3 centre;      ///< m
  double yaw = 0;   ///< rad
  double mass = 0;  ///< kg, > 0
  bool operator==(const BodyBox&) const = default;
};

/// Mass of a body as measured or computed elsewhere, in place of that of its solid shapes.
struct BodyInertia {
  double mass = 0;  ///< kg, > 0
  Vec3 centre;      ///< m, centre of mass, body frame
  /// kg m^2, the tensor about the centre of mass along the axes of the body frame: Ixx, Iyy, Izz
  /// and Ixy, Ixz, Iyz, which are elements of the tensor, as in URDF and SDF: minus the integral of
  /// x y.
  Vec3 moments, products;
  bool operator==(const BodyInertia&) const = default;
};

/// Limits at which the motor controller lets a velocity command grow and decrease; each > 0.
struct AccelerationLimits {
  double linear_up = 0.8;      ///< m/s^2
  double linear_down = 1.5;    ///< m/s^2
  double angular_up = 1.6;     ///< rad/s^2
  double angular_down = 3.14;  ///< rad/s^2
  bool operator==(const AccelerationLimits&) const = default;
};

/// Infrared ranger with a horizontal sector as its field of view.
struct InfraredSensor {
  Vec3 position;          ///< m, of the emitter
  double heading = 0;     ///< rad
  double half_angle = 0;  ///< rad, 0 .. pi/2 exclusive
  InfraredCurve curve = InfraredCurve::gp2d12();
  double noise_sigma = 0;  ///< V, >= 0, standard deviation of the output
  Duration hold_period{};  ///< Time between two measurements; 0: measures when asked
  Converter converter;
  bool operator==(const InfraredSensor&) const = default;
};

/// Level of detail of simulated wheels. Real robots ignore it.
enum class WheelLevel : std::uint8_t {
  kJointed,  ///< Each wheel is a body on a hinge with a motor.
  /// The wheels are part of the body; their surfaces move where they touch the ground. About 3.5
  /// times faster; neglects the inertia of the turning wheels.
  kContact,
};

struct RobotDescription {
  std::string model;
  std::vector<BodyCylinder> cylinders;  ///< At least one cylinder or box.
  std::vector<BodyBox> boxes;
  /// Of all but the driven wheels: the masses of shapes and casters do not count beside it.
  std::optional<BodyInertia> inertia{};
  double friction = 0.3;      ///< Coefficient against walls, motes, robots; >= 0.
  std::vector<Wheel> wheels;  ///< >= 3, casters included; see WheelDrive.
  WheelLevel wheel_level = WheelLevel::kJointed;
  AccelerationLimits acceleration;
  int encoder_steps = 0;  ///< Per turn of a wheel; 0: continuous.
  std::vector<InfraredSensor> infrared;
  std::vector<SensorDescription> sensors;  ///< All other sensors; names differ.
  bool operator==(const RobotDescription&) const = default;
};

/// A mote: a solid, homogeneous box that lies on the ground and can be pushed.
struct MoteDescription {
  std::string model;
  Vec3 size{0.05, 0.05, 0.05};               ///< m, each > 0
  double mass = 0.05;                        ///< kg, > 0
  double friction = 0.6;                     ///< Coefficient against everything; >= 0.
  std::vector<SensorDescription> sensors{};  ///< Names differ.
  bool operator==(const MoteDescription&) const = default;
};

}  // namespace hal::node::devices
