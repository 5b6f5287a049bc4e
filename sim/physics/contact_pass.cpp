#include "sim/physics/contact_pass.h"

#include <algorithm>
#include <span>

namespace sim::physics {
namespace {

constexpr int kContactsPerPair = 4;

struct Joined {
  int contacts = 0;
  double depth = 0;  ///< m, of the deepest contact
};

/// Up to four contacts between two geometries, with friction, as joints.
Joined join(const OdeWorld& world, dGeomID a, dGeomID b, double friction) {
  std::array<dContact, kContactsPerPair> contacts{};
  const int count = dCollide(a, b, kContactsPerPair, &contacts[0].geom, sizeof(dContact));
  Joined joined{count, 0};
  for (dContact& contact : std::span(contacts).first(static_cast<std::size_t>(count))) {
    joined.depth = std::max(joined.depth, contact.geom.depth);
    contact.surface.mode = dContactApprox1;
    contact.surface.mu = friction;
    const dJointID joint = dJointCreateContact(world.dynamics(), world.contacts(), &contact);
    dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
  }
  return joined;
}

const Solid& solid_of(dGeomID geometry) {
  return *static_cast<const Solid*>(dGeomGetData(geometry));
}

bool is_awake(dBodyID body) { return body != nullptr && dBodyIsEnabled(body) != 0; }

}  // namespace

void ContactPass::run(hal::Time now) {
  now_ = now;
  forget();
  if (!Clearance::measures(objects_))
    for (const AwakeList::Member i : awake_.members()) zones_.place(i);
  if (clearance_.may_touch(objects_)) {
    dSpaceCollide(world_.space(), this, [](void* self, dGeomID a, dGeomID b) {
      static_cast<ContactPass*>(self)->touch(a, b);
    });
  }
  for (const AwakeList::Member i : awake_.members()) {
    const Object& object = *objects_[i];
    if (object.drivetrain != nullptr)
      object.drivetrain->touch_ground(world_);
    else
      stand_on_ground(object);
  }
}

void ContactPass::forget() {
  deepest_ = 0;
  islands_.reset();
  for (std::size_t i = touched_.size(); i < objects_.size(); ++i)
    islands_.add_object(objects_[i]->drivetrain != nullptr);
  touched_.resize(objects_.size());
  std::erase_if(touching_, [this](std::size_t object) { return !count_rest(object); });
}

/// A body that falls asleep does not move: its contacts in that step last until an awake object
/// touches it and wakes it. @return whether it has contacts.
bool ContactPass::count_rest(std::size_t object) {
  std::array<bool, 3>& touched = touched_[object];
  Object& sleeper = *objects_[object];
  if (sleeper.awake() || sleeper.frozen) touched = {};
  const auto [wall, robot, mote] = touched;  // in the order of Solid::Kind
  if (wall) ++sleeper.contacts.walls.steps;
  if (robot) ++sleeper.contacts.robots.steps;
  if (mote) ++sleeper.contacts.motes.steps;
  if (robot || mote) ++sleeper.contacts.bodies.steps;
  return wall || robot || mote;
}

/// Sleeping objects in contact wake each other in the same step, so these stay in the search.
void ContactPass::rest(std::size_t object) {
  const auto [wall, robot, mote] = touched_[object];
  if (!Clearance::measures(objects_) && !robot && !mote) zones_.rest(object);
}

void ContactPass::note(ContactRecord& record) const {
  ++record.steps;
  if (!record.first) record.first = now_;
}

void ContactPass::touch(dGeomID a, dGeomID b) {
  const dBodyID body_a = dGeomGetBody(a);
  const dBodyID body_b = dGeomGetBody(b);
  // Two sleepers stay asleep; tested first, because the exact test is the expensive part.
  if (body_a == body_b || (!is_awake(body_a) && !is_awake(body_b))) return;
  const Solid& solid_a = solid_of(a);
  const Solid& solid_b = solid_of(b);
  const auto [contacts, depth] = join(world_, a, b, std::min(solid_a.friction, solid_b.friction));
  if (contacts == 0) return;
  deepest_ = std::max(deepest_, depth);
  record(solid_a, solid_b);
  record(solid_b, solid_a);
  count(solid_a, solid_b, contacts);
}

void ContactPass::record(const Solid& self, const Solid& other) {
  if (self.kind == Solid::Kind::kWall) return;
  Object& object = *objects_[self.object];
  if (!object.awake()) object.wake();
  awake_.add(self.object);
  std::array<bool, 3>& touched = touched_[self.object];
  bool& known = touched[static_cast<std::size_t>(other.kind)];
  if (known) return;
  const bool first_body = !touched[static_cast<std::size_t>(Solid::Kind::kRobot)] &&
                          !touched[static_cast<std::size_t>(Solid::Kind::kMote)];
  if (touched == std::array<bool, 3>{}) touching_.push_back(self.object);
  known = true;
  Contacts& contacts = object.contacts;
  if (other.kind == Solid::Kind::kWall) return note(contacts.walls);
  note(other.kind == Solid::Kind::kMote ? contacts.motes : contacts.robots);
  if (first_body) note(contacts.bodies);
}

void ContactPass::count(const Solid& a, const Solid& b, int contacts) {
  if (a.kind == Solid::Kind::kWall)
    islands_.add(b.object, contacts);
  else if (b.kind == Solid::Kind::kWall)
    islands_.add(a.object, contacts);
  else
    islands_.join(a.object, b.object, contacts);
}

void ContactPass::stand_on_ground(const Object& mote) {
  if (!mote.awake()) return;
  for (const dGeomID geometry : mote.geometries) {
    const dReal* p = dGeomGetPosition(geometry);
    join(world_, geometry, world_.ground_plane({p[0], p[1]}),
         std::min(mote.friction, ground_friction_));
  }
}

}  // namespace sim::physics
