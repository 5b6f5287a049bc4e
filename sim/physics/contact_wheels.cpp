#include <algorithm>

#include "sim/physics/wheels.h"

namespace sim::physics {
namespace {

using hal::Vec3;

/// A sphere that is part of the chassis; its surface moves relative to the contact with the ground.
struct ContactWheel {
  Vec3 offset;  ///< m, centre relative to the chassis's centre of mass, in the chassis frame
  Vec3 slip;    ///< Unit vector, body frame of the chassis.
  double radius;
  double lever;  ///< m
  double mu;
  double mu2;
  double max_torque;
  double unit_loss;     ///< W in the winding at 1 N m.
  double load;          ///< N on the ground in the last step with contact
  double speed = 0;     ///< rad/s of the surface.
  bool yields = false;  ///< The torque, not the grip, limits the force.
  GroundContact ground;
};

class ContactWheels final : public Wheels {
 public:
  ContactWheels(const RigidBody& chassis, const std::vector<hal::node::devices::Wheel>& wheels,
                double weight_on_each, bool measure_energy);
  ContactWheels(const ContactWheels&) = delete;
  ContactWheels& operator=(const ContactWheels&) = delete;

  void turn(std::span<const double> speeds) override {
    for (std::size_t i = 0; i < wheels_.size(); ++i) wheels_[i].speed = speeds[i];
  }
  void set_power(bool on) override { power_ = on; }
  void touch_ground(const OdeWorld& world) override;
  void follow(double seconds, std::span<double> angles) override;
  std::span<const dBodyID> bodies() const override { return {}; }

 private:
  double grip(ContactWheel& wheel) const;
  double turned(ContactWheel& wheel, double seconds);
  void book(const ContactWheel& wheel, const Vec3& after, double seconds);

  RigidBody chassis_;
  bool measures_;
  bool power_ = true;
  std::vector<ContactWheel> wheels_;
};

ContactWheels::ContactWheels(const RigidBody& chassis,
                             const std::vector<hal::node::devices::Wheel>& wheels,
                             double weight_on_each, bool measure_energy)
    : chassis_(chassis), measures_(measure_energy) {
  // The solver writes feedback to them, so their addresses must not change.
  wheels_.reserve(wheels.size());
  for (const hal::node::devices::Wheel& wheel : wheels) {
    const Vec3 place{wheel.position.x, wheel.position.y, wheel.radius};
    wheels_.push_back({place - chassis.centre_of_mass,
                       horizontal(wheel.slip_heading()),
                       wheel.radius,
                       lever(wheel),
                       wheel.mu,
                       wheel.mu2,
                       wheel.max_torque,
                       wheel.copper_loss(1),
                       weight_on_each,
                       0,
                       false,
                       {}});
  }
}

/// Coefficient of friction along the grip: that of the tyre or, if lower, the one that corresponds
/// to the motor's torque at the load of the step before.
double ContactWheels::grip(ContactWheel& wheel) const {
  wheel.yields = !power_ || wheel.max_torque < wheel.mu * wheel.lever * wheel.load;
  if (!power_) return 0;
  return wheel.yields ? wheel.max_torque / (wheel.lever * wheel.load) : wheel.mu;
}

void ContactWheels::touch_ground(const OdeWorld& world) {
  const dReal* p = dBodyGetPosition(chassis_.body);
  const Vec3 centre{p[0], p[1], p[2]};
  dContact contact{};
  for (ContactWheel& wheel : wheels_) {
    const WheelSphere sphere{chassis_.body, centre + rotate(chassis_.body, wheel.offset),
                             rotate(chassis_.body, wheel.slip), wheel.radius};
    if (!meet_ground(world.ground(), sphere, contact, wheel.ground)) continue;
    if (measures_) wheel.ground.velocity = material_velocity(chassis_.body, wheel.ground.arm);
    contact.surface.mode |= dContactMotion1;
    contact.surface.mu = grip(wheel);
    contact.surface.mu2 = wheel.mu2;
    contact.surface.motion1 = wheel.speed * wheel.lever;
    const dJointID joint = dJointCreateContact(world.dynamics(), world.contacts(), &contact);
    dJointAttach(joint, chassis_.body, nullptr);
    dJointSetFeedback(joint, &wheel.ground.forces);
  }
}

void ContactWheels::follow(double seconds, std::span<double> angles) {
  for (std::size_t i = 0; i < wheels_.size(); ++i) angles[i] += turned(wheels_[i], seconds);
}

/// Rotation in the step [rad]. A wheel whose motor is too weak for the load, or off, rolls with the
/// ground; any other wheel turns at the commanded speed, whether it grips or spins.
double ContactWheels::turned(ContactWheel& wheel, double seconds) {
  const GroundContact& ground = wheel.ground;
  if (!ground.touches) return (power_ ? wheel.speed : 0) * seconds;
  wheel.load = std::max(hal::dot(ground.force(), ground.normal), 0.0);
  if (!wheel.yields && !measures_) return wheel.speed * seconds;
  const Vec3 after = material_velocity(chassis_.body, ground.arm);
  if (measures_) book(wheel, after, seconds);
  const double passing = hal::dot(after, ground.grip) / wheel.lever;
  return (wheel.yields ? passing : wheel.speed) * seconds;
}

/// Records energies. @param after  velocity of the chassis's material at the contact, after the
/// step.
void ContactWheels::book(const ContactWheel& wheel, const Vec3& after, double seconds) {
  const GroundContact& ground = wheel.ground;
  const Vec3 force = ground.force();
  const Vec3 mean = 0.5 * (ground.velocity + after);
  const double surface = wheel.yields ? hal::dot(mean, ground.grip) : wheel.speed * wheel.lever;
  const double along = hal::dot(force, ground.grip);
  const double driven = along * surface * seconds;
  const double torque = along * wheel.lever;
  book_motor(driven, wheel.unit_loss * torque * torque * seconds);
  friction_loss_ += driven - hal::dot(force, mean) * seconds;
}

}  // namespace

std::unique_ptr<Wheels> make_contact_wheels(const RigidBody& chassis,
                                            const std::vector<hal::node::devices::Wheel>& wheels,
                                            double weight_on_each, bool measure_energy) {
  return std::make_unique<ContactWheels>(chassis, wheels, weight_on_each, measure_energy);
}

}  // namespace sim::physics
