#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "hal/node/devices/robot_description.h"
#include "sim/physics/ode_world.h"
#include "sim/physics/rigid_body.h"

namespace sim::physics {

/// The wheels of one robot at one level of detail: how they are driven, how they touch the ground
/// and how far they have turned. Every contact with the ground has high friction perpendicular to
/// the wheel's slip heading, which for an omni or a fixed wheel is its rolling direction, and
/// yields along it: easily, like rollers, or hardly, like the tyre of a fixed wheel.
///
/// A step is: turn(), touch_ground(), the solver, follow().
class Wheels {
 public:
  virtual ~Wheels() = default;

  /// Sets the speeds of the driven wheels [rad/s], with the sign convention of
  /// hal::node::devices::Wheel.
  virtual void turn(std::span<const double> speeds) = 0;

  /// Switches the power; without power the motors neither drive nor brake.
  virtual void set_power(bool on) = 0;

  /// Adds contact joints of the wheels with the ground.
  virtual void touch_ground(const OdeWorld& world) = 0;

  /// Adds the rotation of the wheels in the step to `angles` [rad], and records energies if the
  /// world measures them.
  virtual void follow(double seconds, std::span<double> angles) = 0;

  /// Bodies of the wheels; empty if they are part of the chassis.
  virtual std::span<const dBodyID> bodies() const = 0;

  double motor_work() const { return motor_work_; }        ///< J since the start.
  double friction_loss() const { return friction_loss_; }  ///< J since the start, at the ground
  double motor_input() const { return motor_input_; }      ///< J since the start, as in Energy

 protected:
  /// Records a motor's energies in a step. @param work  J, < 0 while it brakes. @param heat  J, in
  /// its winding.
  void book_motor(double work, double heat) {
    motor_work_ += work;
    motor_input_ += std::max(0.0, work + heat);
  }

  double motor_work_ = 0;
  double friction_loss_ = 0;

 private:
  double motor_input_ = 0;
};

/// A wheel's contact with the ground, and its effect in a step, at both levels of detail.
struct GroundContact {
  bool touches = false;
  hal::Vec3 arm;     ///< m, from the body's centre of mass, at the start of the step
  hal::Vec3 normal;  ///< Unit vector out of the ground, world frame.
  /// Unit vector, world frame: direction in which a positive speed drives the body.
  hal::Vec3 grip;
  /// m/s, of the body's material at the contact, before the step; for energies only
  hal::Vec3 velocity;
  dJointFeedback forces;  ///< Forces of the step; valid if requested.

  hal::Vec3 force() const { return {forces.f1[0], forces.f1[1], forces.f1[2]}; }  ///< N
};

/// The sphere of a wheel in the world. It is not an ODE geometry: it touches only the ground,
/// represented by its tangent plane below the centre.
struct WheelSphere {
  dBodyID body;      ///< The body to which it belongs.
  hal::Vec3 centre;  ///< m, world frame
  hal::Vec3 slip;    ///< Unit vector, world frame: Wheel::slip_heading().
  double radius;     ///< m
};

/// Unit vector in the horizontal plane at an angle from the body's x axis. rad
hal::Vec3 horizontal(double heading);

/// Lever of a wheel [m]: distance that the ground moves along the grip per radian of a wheel
/// without slip, and torque of the motor per newton of grip.
double lever(const hal::node::devices::Wheel& wheel);

/// Computes where and in which directions a wheel touches the ground: friction `mu` along the grip,
/// `mu2` across it. @param contact  zeroed, or from another wheel.
/// @return whether they touch.
bool meet_ground(const Ground& ground, const WheelSphere& wheel, dContact& contact,
                 GroundContact& met);

/// Velocity of a body's material at `arm` from its centre of mass; world frame. m/s
inline hal::Vec3 material_velocity(dBodyID body, const hal::Vec3& arm) {
  const dReal* v = dBodyGetLinearVel(body);
  const dReal* w = dBodyGetAngularVel(body);
  return {v[0] + w[1] * arm.z - w[2] * arm.y, v[1] + w[2] * arm.x - w[0] * arm.z,
          v[2] + w[0] * arm.y - w[1] * arm.x};
}

/// Makes one body and one hinge motor per wheel. @param wheels  driven ones, here and below.
std::unique_ptr<Wheels> make_jointed_wheels(const OdeWorld& world, const RigidBody& chassis,
                                            const std::vector<hal::node::devices::Wheel>& wheels,
                                            const WorldConfig& config);

/// Makes spheres on the chassis whose surface moves at the wheel's speed. @param weight_on_each  N
std::unique_ptr<Wheels> make_contact_wheels(const RigidBody& chassis,
                                            const std::vector<hal::node::devices::Wheel>& wheels,
                                            double weight_on_each, bool measure_energy);

}  // namespace sim::physics
