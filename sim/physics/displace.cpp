#include "sim/physics/displace.h"

#include <algorithm>

namespace sim::physics {
namespace {

/// Position and rotation of one body in the frame of another.
struct Relative {
  dVector3 position;
  dMatrix3 rotation;
};

Relative relative(dBodyID body, dBodyID to) {
  Relative it{};
  const dReal* p = dBodyGetPosition(body);
  dBodyGetPosRelPoint(to, p[0], p[1], p[2], it.position);
  dMultiply1(it.rotation, dBodyGetRotation(to), dBodyGetRotation(body), 3, 3, 3);
  return it;
}

void stop(dBodyID body) {
  dBodySetLinearVel(body, 0, 0, 0);
  dBodySetAngularVel(body, 0, 0, 0);
}

}  // namespace

void displace(Object& object, const hal::Pose2& pose, const Ground& ground) {
  const dBodyID main = object.rigid.body;
  std::vector<Relative> others;
  for (const dBodyID body : object.bodies) others.push_back(relative(body, main));
  stand(object.rigid, pose, ground);
  for (std::size_t i = 1; i < others.size(); ++i) {
    const dBodyID body = object.bodies[i];
    dVector3 position;
    dBodyGetRelPointPos(main, others[i].position[0], others[i].position[1], others[i].position[2],
                        position);
    dBodySetPosition(body, position[0], position[1], position[2]);
    dMatrix3 turned;
    dMultiply0(turned, dBodyGetRotation(main), others[i].rotation, 3, 3, 3);
    dBodySetRotation(body, turned);
  }
  std::ranges::for_each(object.bodies, stop);
  object.wake();
  object.pose.reset();
}

}  // namespace sim::physics
