#pragma once

#include <ode/ode.h>

#include "hal/types/geometry.h"

namespace sim::physics {

/// How a movable rubs on what it touches.
struct Rubbing {
  double softness = 0;    ///< ODE's CFM of its contacts.
  double rolling = 0;     ///< m, lever of the torque against rolling, per newton of load
  bool is_round = false;  ///< It rolls in any direction; else only about its z axis.
  hal::Vec3 pull;         ///< m/s that gravity adds to a free body in the step.
  hal::Vec3 push;         ///< Direction in which other bodies push it; zero: none does.
};

/// Aligns the friction of a contact with the velocity at which the bodies would slide at the end of
/// the step. ODE limits friction along two axes, not the length of its vector: only along an axis
/// the limit is that of Coulomb's law; between them it is up to 1.41 times as high. The first axis
/// of bodies that do not slide is along the push. @param b  null: the ground or a wall.
void align_friction(dContact& contact, dBodyID a, dBodyID b, const Rubbing& rubbing);

/// Adds the resistance to rolling, unless the body stands on a face.
void resist_rolling(dContact& contact, dBodyID body, const Rubbing& rubbing);

}  // namespace sim::physics
