#pragma once

#include "sim/physics/awake_list.h"
#include "sim/physics/clearance.h"
#include "sim/physics/contact_islands.h"
#include "sim/physics/object.h"
#include "sim/physics/ode_world.h"
#include "sim/physics/quiet_zones.h"

namespace sim::physics {

/// Finds the contacts before a step, makes the contact joints and keeps the contact records.
class ContactPass {
 public:
  /// @param awake  the objects that may be awake; objects woken by a contact are added.
  ContactPass(const OdeWorld& world, Objects& objects, AwakeList& awake, double ground_friction)
      : world_(world),
        objects_(objects),
        awake_(awake),
        zones_(objects),
        ground_friction_(ground_friction) {}

  ~ContactPass();
  ContactPass(const ContactPass&) = delete;
  ContactPass& operator=(const ContactPass&) = delete;

  /// @param now  start of the step. Contacts between objects come before those with the ground,
  /// because an object that is woken by a push must stand on the ground in the same step.
  void run(hal::Time now);

  /// Reports that an object has fallen asleep in the step after the last run().
  void rest(std::size_t object);

  /// Adds a wall of the world, before the first run().
  void add_wall(dGeomID geometry, const Shape& wall) {
    walls_.push_back(geometry);
    clearance_.add_wall(wall);
  }

  /// Whether an object touched nothing but the ground in the last run().
  bool is_alone(std::size_t object) const { return touched_[object] == Touched{}; }

  /// Groups of objects in contact, from the last run().
  ContactIslands& islands() { return islands_; }

  /// Largest depth of a contact other than with the ground, from the last run(). m
  double deepest_overlap() const { return deepest_; }

 private:
  using Touched = std::array<bool, 4>;  ///< By Solid::Kind.

  void forget();
  bool count_rest(std::size_t object);
  void settle();
  void touch_walls();
  void touch(dGeomID a, dGeomID b);
  void record(const Solid& self, const Solid& other);
  void note(ContactRecord& record) const;
  void count(const Solid& a, const Solid& b, int contacts);
  void stand_on_ground(const Object& object);
  const Object* movable_of(const Solid& a, const Solid& b) const;

  const OdeWorld& world_;
  Objects& objects_;
  AwakeList& awake_;
  QuietZones zones_;
  double ground_friction_;
  ContactIslands islands_;
  Clearance clearance_;
  std::vector<dGeomID> walls_;
  bool has_settled_ = false;  ///< After the first run().
  bool walls_are_apart_ = false;
  std::vector<std::uint32_t> near_;
  hal::Time now_{};
  double deepest_ = 0;
  /// Per object and kind: contact recorded in this step.
  std::vector<Touched> touched_;
  std::vector<std::size_t> touching_;  ///< The objects with any of these set.
};

}  // namespace sim::physics
