#pragma once

#include <ode/ode.h>

#include <vector>

#include "sim/physics/awake_list.h"
#include "sim/physics/object.h"

namespace sim::physics {

/// Poses and velocities of awake bodies, to repeat a step that the exact solver failed to solve.
class BodyStates {
 public:
  void keep(const Objects& objects, std::span<const AwakeList::Member> awake);
  void restore() const;

 private:
  struct State {
    dBodyID body;
    dVector3 position, linear, angular;
    dQuaternion rotation;
  };
  std::vector<State> states_;
};

}  // namespace sim::physics
