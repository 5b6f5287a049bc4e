#include "sim/physics/casters.h"

#include "sim/physics/wheels.h"

namespace sim::physics {

using hal::Vec3;

Casters::Casters(const RigidBody& chassis, const std::vector<hal::node::devices::Wheel>& wheels)
    : chassis_(chassis) {
  for (const hal::node::devices::Wheel& wheel : wheels) {
    if (wheel.is_driven()) continue;
    const Vec3 place{wheel.position.x, wheel.position.y, wheel.radius};
    balls_.push_back({place - chassis.centre_of_mass, horizontal(wheel.slip_heading()),
                      wheel.radius, wheel.mu, wheel.mu2});
  }
}

void Casters::touch_ground(const OdeWorld& world) const {
  if (balls_.empty()) return;
  const dReal* p = dBodyGetPosition(chassis_.body);
  dContact contact{};
  GroundContact ground;
  for (const Ball& ball : balls_) {
    const Vec3 centre = Vec3{p[0], p[1], p[2]} + rotate(chassis_.body, ball.offset);
    if (!meet_ground(world.ground(),
                     {chassis_.body, centre, rotate(chassis_.body, ball.slip), ball.radius},
                     contact, ground))
      continue;
    contact.surface.mu = ball.mu;
    contact.surface.mu2 = ball.mu2;
    dJointAttach(dJointCreateContact(world.dynamics(), world.contacts(), &contact), chassis_.body,
                 nullptr);
  }
}

}  // namespace sim::physics
