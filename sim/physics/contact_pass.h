#pragma once

#include "sim/physics/awake_list.h"
#include "sim/physics/clearance.h"
#include "sim/physics/contact_islands.h"
#include "sim/physics/object.h"
#include "sim/physics/ode_world.h"
#include "sim/physics/quiet_zones.h"

namespace sim::physics {

/// Finds what touches what before a step, makes the contact joints and keeps the records.
class ContactPass {
 public:
  /// @param awake  the objects that may be awake; those that are woken by a touch are added.
  ContactPass(const OdeWorld& world, Objects& objects, AwakeList& awake, double ground_friction)
      : world_(world),
        objects_(objects),
        awake_(awake),
        zones_(objects),
        ground_friction_(ground_friction) {}

  /// @param now  start of the step. Objects first, then the ground: whoever is woken by a push must
  /// stand on the ground in this very step.
  void run(hal::Time now);

  /// An object has fallen asleep in the step after the last run().
  void rest(std::size_t object);

  /// A wall that was added to the world.
  void add_wall(const Shape& wall) { clearance_.add_wall(wall); }

  /// Who touches whom, from the last run().
  ContactIslands& islands() { return islands_; }

  /// m, over all contacts except those with the ground, from the last run().
  double deepest_overlap() const { return deepest_; }

 private:
  void forget();
  bool count_rest(std::size_t object);
  void touch(dGeomID a, dGeomID b);
  void record(const Solid& self, const Solid& other);
  void note(ContactRecord& record) const;
  void count(const Solid& a, const Solid& b, int contacts);
  void stand_on_ground(const Object& mote);

  const OdeWorld& world_;
  Objects& objects_;
  AwakeList& awake_;
  QuietZones zones_;
  double ground_friction_;
  ContactIslands islands_;
  Clearance clearance_;
  hal::Time now_{};
  double deepest_ = 0;
  std::vector<std::array<bool, 3>> touched_;  ///< Per object and kind: recorded in this step.
  std::vector<std::size_t> touching_;         ///< Those of which something is.
};

}  // namespace sim::physics
