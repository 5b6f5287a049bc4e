#include "sim/physics/wheels.h"

namespace sim::physics {
namespace {

using hal::Vec3;

/// A sphere with its own body on a motorised hinge.
struct JointedWheel {
  dJointID hinge;
  dBodyID body;
  double radius;
  Vec3 slip;  ///< Unit vector, body frame of the chassis.
  double mu;
  double mu2;
  double max_torque;
  bool has_oblique_rollers;
  double unit_loss;  ///< W in the winding at 1 N m.
  double rate = 0;   ///< rad/s, of the hinge before the step
  GroundContact ground;
  dJointFeedback motor;
};

class JointedWheels final : public Wheels {
 public:
  JointedWheels(const OdeWorld& world, const RigidBody& chassis,
                const std::vector<hal::node::devices::Wheel>& wheels, const WorldConfig& config)
      : chassis_(chassis),
        measures_(config.measure_energy),
        half_step_(0.5 * hal::to_seconds(config.step)) {
    // The solver writes feedback to them, so their addresses must not change.
    wheels_.reserve(wheels.size());
    for (const hal::node::devices::Wheel& wheel : wheels) mount(world, wheel);
  }
  JointedWheels(const JointedWheels&) = delete;
  JointedWheels& operator=(const JointedWheels&) = delete;

  void turn(std::span<const double> speeds) override;
  void set_power(bool on) override;
  void touch_ground(const OdeWorld& world) override;
  void follow(double seconds, std::span<double> angles) override;
  std::span<const dBodyID> bodies() const override { return bodies_; }

 private:
  void mount(const OdeWorld& world, const hal::node::devices::Wheel& wheel);
  void book(const JointedWheel& wheel, double seconds);
  Vec3 slip_of(const JointedWheel& wheel) const;

  RigidBody chassis_;
  bool measures_;
  double half_step_;  ///< s
  std::vector<dBodyID> bodies_;
  std::vector<JointedWheel> wheels_;
};

void JointedWheels::mount(const OdeWorld& world, const hal::node::devices::Wheel& wheel) {
  const dBodyID body = dBodyCreate(world.dynamics());
  dMass mass;
  dMassSetSphereTotal(&mass, wheel.mass, wheel.radius);
  dBodySetMass(body, &mass);
  dBodySetRotation(body, dBodyGetRotation(chassis_.body));
  const Vec3 place{wheel.position.x, wheel.position.y, wheel.radius};
  const Vec3 centre = pose_of(chassis_).position + rotate(chassis_.body, place);
  dBodySetPosition(body, centre.x, centre.y, centre.z);

  JointedWheel& joint =
      wheels_.emplace_back(JointedWheel{.hinge = dJointCreateHinge(world.dynamics(), nullptr),
                                        .body = body,
                                        .radius = wheel.radius,
                                        .slip = horizontal(wheel.slip_heading()),
                                        .mu = wheel.mu,
                                        .mu2 = wheel.mu2,
                                        .max_torque = wheel.max_torque,
                                        .has_oblique_rollers = wheel.roller_angle != 0,
                                        .unit_loss = wheel.copper_loss(1),
                                        .rate = 0,
                                        .ground = {},
                                        .motor = {}});
  dJointAttach(joint.hinge, body, chassis_.body);
  dJointSetHingeAnchor(joint.hinge, centre.x, centre.y, centre.z);
  const Vec3 axle = rotate(chassis_.body, horizontal(wheel.axle_heading));
  dJointSetHingeAxis(joint.hinge, axle.x, axle.y, axle.z);
  dJointSetHingeParam(joint.hinge, dParamFMax, wheel.max_torque);
  dJointSetHingeParam(joint.hinge, dParamVel, 0);
  if (measures_) dJointSetFeedback(joint.hinge, &joint.motor);
  bodies_.push_back(body);
}

void JointedWheels::turn(std::span<const double> speeds) {
  // A wheel that drives towards axle + 90 degrees turns backwards about its axle.
  for (std::size_t i = 0; i < wheels_.size(); ++i)
    dJointSetHingeParam(wheels_[i].hinge, dParamVel, -speeds[i]);
}

void JointedWheels::set_power(bool on) {
  for (const JointedWheel& wheel : wheels_)
    dJointSetHingeParam(wheel.hinge, dParamFMax, on ? wheel.max_torque : 0);
}

/// Slip direction of a wheel in the coming step, world frame. On a turning chassis, a wheel with
/// its own body moves along the chord of its arc, which is rotated by half of the chassis's
/// rotation in the step. This does not matter to rollers along the radius; oblique rollers would be
/// 0.5 omega * step too fast or too slow.
Vec3 JointedWheels::slip_of(const JointedWheel& wheel) const {
  const Vec3 slip = rotate(chassis_.body, wheel.slip);
  if (!wheel.has_oblique_rollers) return slip;
  const double turn = half_step_ * dBodyGetAngularVel(chassis_.body)[2];
  return {slip.x - turn * slip.y, slip.y + turn * slip.x, slip.z};
}

void JointedWheels::touch_ground(const OdeWorld& world) {
  dContact contact{};
  for (JointedWheel& wheel : wheels_) {
    if (measures_) wheel.rate = dJointGetHingeAngleRate(wheel.hinge);
    // The directions are those of the chassis; the wheel's own frame turns with the wheel.
    const Vec3 slip = slip_of(wheel);
    const dReal* p = dBodyGetPosition(wheel.body);
    if (!meet_ground(world.ground(), {wheel.body, {p[0], p[1], p[2]}, slip, wheel.radius}, contact,
                     wheel.ground))
      continue;
    contact.surface.mu = wheel.mu;
    contact.surface.mu2 = wheel.mu2;
    const dJointID joint = dJointCreateContact(world.dynamics(), world.contacts(), &contact);
    dJointAttach(joint, wheel.body, nullptr);
    if (!measures_) continue;
    wheel.ground.velocity = material_velocity(wheel.body, wheel.ground.arm);
    dJointSetFeedback(joint, &wheel.ground.forces);
  }
}

void JointedWheels::follow(double seconds, std::span<double> angles) {
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    angles[i] -= dJointGetHingeAngleRate(wheels_[i].hinge) * seconds;
    if (measures_) book(wheels_[i], seconds);
  }
}

/// Work of a force over a step is its product with the mean velocity: exact for the integrator, in
/// which force and arm are constant and the velocity changes linearly.
void JointedWheels::book(const JointedWheel& wheel, double seconds) {
  dVector3 axis;
  dJointGetHingeAxis(wheel.hinge, axis);
  const dReal* t = wheel.motor.t1;
  const double torque = t[0] * axis[0] + t[1] * axis[1] + t[2] * axis[2];
  const double rate = 0.5 * (wheel.rate + dJointGetHingeAngleRate(wheel.hinge));
  book_motor(torque * rate * seconds, wheel.unit_loss * torque * torque * seconds);
  if (!wheel.ground.touches) return;
  const Vec3 after = material_velocity(wheel.body, wheel.ground.arm);
  friction_loss_ -= 0.5 * seconds * hal::dot(wheel.ground.force(), wheel.ground.velocity + after);
}

}  // namespace

std::unique_ptr<Wheels> make_jointed_wheels(const OdeWorld& world, const RigidBody& chassis,
                                            const std::vector<hal::node::devices::Wheel>& wheels,
                                            const WorldConfig& config) {
  return std::make_unique<JointedWheels>(world, chassis, wheels, config);
}

}  // namespace sim::physics
