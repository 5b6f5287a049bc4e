#include "sim/physics/body_states.h"

#include <algorithm>

namespace sim::physics {
namespace {

void copy(const dReal* from, dReal* to, int count) { std::copy_n(from, count, to); }

}  // namespace

void BodyStates::keep(const Objects& objects, std::span<const AwakeList::Member> awake) {
  states_.clear();
  for (const AwakeList::Member i : awake) {
    for (const dBodyID body : objects[i]->bodies) {
      if (dBodyIsEnabled(body) == 0) continue;
      State& state = states_.emplace_back();
      state.body = body;
      copy(dBodyGetPosition(body), state.position, 3);
      copy(dBodyGetLinearVel(body), state.linear, 3);
      copy(dBodyGetAngularVel(body), state.angular, 3);
      copy(dBodyGetQuaternion(body), state.rotation, 4);
    }
  }
}

void BodyStates::restore() const {
  for (const State& state : states_) {
    const auto& [body, position, linear, angular, rotation] = state;
    dBodySetPosition(body, position[0], position[1], position[2]);
    dBodySetQuaternion(body, rotation);
    dBodySetLinearVel(body, linear[0], linear[1], linear[2]);
    dBodySetAngularVel(body, angular[0], angular[1], angular[2]);
    dBodyEnable(body);
  }
}

}  // namespace sim::physics
