#include "sim/physics/drivetrain.h"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>

#include "hal/types/math.h"

namespace sim::physics {

using hal::Vec3;

namespace {

void check(const hal::devices::RobotDescription& robot) {
  for (const hal::devices::Wheel& wheel : robot.wheels)
    if (!(wheel.mass > 0) || !(wheel.max_torque > 0) || !(wheel.mu > 0) || !(wheel.mu2 >= 0))
      throw std::invalid_argument(
          fmt::format("wheel: mass {} kg, max_torque {} N m, mu {}, mu2 {}: must be positive "
                      "(mu2: or 0)",
                      wheel.mass, wheel.max_torque, wheel.mu, wheel.mu2));
  const auto& a = robot.acceleration;
  for (const double limit : {a.linear_up, a.linear_down, a.angular_up, a.angular_down})
    if (!(limit > 0))
      throw std::invalid_argument(fmt::format("acceleration limit {}: must be positive", limit));
}

}  // namespace

Drivetrain::Drivetrain(const OdeWorld& world, const RigidBody& chassis,
                       const hal::devices::RobotDescription& robot)
    : drive_(robot.wheels),
      profile_(robot.acceleration),
      chassis_(chassis),
      bodies_{chassis.body},
      angles_(robot.wheels.size(), 0.0) {
  check(robot);
  for (const hal::devices::Wheel& wheel : robot.wheels) wheels_.push_back(mount(world, wheel));
}

Drivetrain::~Drivetrain() {
  for (const WheelJoint& wheel : wheels_) dGeomDestroy(wheel.sphere);
}

Drivetrain::WheelJoint Drivetrain::mount(const OdeWorld& world, const hal::devices::Wheel& wheel) {
  const dBodyID body = dBodyCreate(world.dynamics());
  dMass mass;
  dMassSetSphereTotal(&mass, wheel.mass, wheel.radius);
  dBodySetMass(body, &mass);
  dBodySetRotation(body, dBodyGetRotation(chassis_.body));
  const Vec3 place{wheel.position.x, wheel.position.y, wheel.radius};
  const Vec3 centre = pose_of(chassis_).position + rotate(chassis_.body, place);
  dBodySetPosition(body, centre.x, centre.y, centre.z);

  WheelJoint joint{dJointCreateHinge(world.dynamics(), nullptr),
                   dCreateSphere(nullptr, wheel.radius),
                   {hal::math::cos(wheel.axle_heading), hal::math::sin(wheel.axle_heading), 0},
                   wheel.mu,
                   wheel.mu2};
  dGeomSetBody(joint.sphere, body);
  dJointAttach(joint.hinge, body, chassis_.body);
  dJointSetHingeAnchor(joint.hinge, centre.x, centre.y, centre.z);
  const Vec3 axle = rotate(chassis_.body, joint.axle);
  dJointSetHingeAxis(joint.hinge, axle.x, axle.y, axle.z);
  dJointSetHingeParam(joint.hinge, dParamFMax, wheel.max_torque);
  dJointSetHingeParam(joint.hinge, dParamVel, 0);
  bodies_.push_back(body);
  return joint;
}

void Drivetrain::actuate(hal::Duration step) {
  const hal::Twist2 wanted = profile_.advance(target_, step);
  keep_awake(wanted != hal::Twist2{} || target_ != hal::Twist2{});
  // Turning and translating follow separate ramps, so that on the way from one reachable velocity
  // to another a wheel could still be asked for too much.
  const std::vector<double> speeds = drive_.wheel_speeds(drive_.saturate(wanted).twist);
  // A wheel that drives towards axle + 90 degrees turns backwards about its axle.
  for (std::size_t i = 0; i < wheels_.size(); ++i)
    dJointSetHingeParam(wheels_[i].hinge, dParamVel, -speeds[i]);
}

void Drivetrain::keep_awake(bool moving) {
  if (moving == moving_) return;
  moving_ = moving;
  for (const dBodyID body : bodies_) {
    dBodySetAutoDisableFlag(body, moving ? 0 : 1);
    // A sleeping body does not notice a new motor speed.
    if (moving) dBodyEnable(body);
  }
}

void Drivetrain::touch_ground(const OdeWorld& world) {
  if (dBodyIsEnabled(chassis_.body) == 0) return;
  for (const WheelJoint& wheel : wheels_) {
    dContact contact{};
    if (dCollide(wheel.sphere, world.ground(), 1, &contact.geom, sizeof contact) == 0) continue;
    contact.surface.mode = dContactFDir1 | dContactMu2 | dContactApprox1;
    contact.surface.mu = wheel.mu;
    contact.surface.mu2 = wheel.mu2;
    // The rolling direction follows the chassis; the wheel's own frame turns with the wheel.
    const Vec3 axle = rotate(chassis_.body, wheel.axle);
    const dReal* n = contact.geom.normal;
    const Vec3 rolling{n[1] * axle.z - n[2] * axle.y, n[2] * axle.x - n[0] * axle.z,
                       n[0] * axle.y - n[1] * axle.x};
    const double length = std::sqrt(dot(rolling, rolling));
    contact.fdir1[0] = rolling.x / length;
    contact.fdir1[1] = rolling.y / length;
    contact.fdir1[2] = rolling.z / length;
    const dJointID joint = dJointCreateContact(world.dynamics(), world.contacts(), &contact);
    dJointAttach(joint, dGeomGetBody(wheel.sphere), nullptr);
  }
}

void Drivetrain::follow(hal::Duration step) {
  if (dBodyIsEnabled(chassis_.body) == 0) return;
  for (std::size_t i = 0; i < wheels_.size(); ++i)
    angles_[i] -= dJointGetHingeAngleRate(wheels_[i].hinge) * hal::to_seconds(step);
}

}  // namespace sim::physics
