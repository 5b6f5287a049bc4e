#include "sim/physics/contact_pass.h"

#include <algorithm>
#include <span>

#include "sim/physics/manifold.h"

namespace sim::physics {
namespace {

/// Most contacts that are asked for; those of a movable are chosen among them.
constexpr std::size_t kMostFound = 16;

struct Joined {
  int contacts = 0;
  double depth = 0;  ///< m, of the deepest contact
  hal::Vec3 push;    ///< Sum of the normals, into `a`.
};

/// @param movable  null: none takes part.
struct Surfaces {
  double friction = 0;
  const Object* movable = nullptr;
};

std::size_t find_contacts(dGeomID a, dGeomID b, std::span<dContact> contacts) {
  const int most = static_cast<int>(contacts.size());
  return static_cast<std::size_t>(dCollide(a, b, most, &contacts[0].geom, sizeof(dContact)));
}

/// Up to four contacts between two geometries, with friction, as joints.
Joined join(const OdeWorld& world, dGeomID a, dGeomID b, const Surfaces& surfaces) {
  std::array<dContact, kMostFound> contacts;
  const std::size_t most = surfaces.movable == nullptr ? kContactsPerPair : kMostFound;
  const std::size_t found = find_contacts(a, b, std::span(contacts).first(most));
  const std::size_t count = choose_support(std::span(contacts).first(found));
  Joined joined{static_cast<int>(count), 0, {}};
  for (dContact& contact : std::span(contacts).first(count)) {
    joined.depth = std::max(joined.depth, contact.geom.depth);
    contact.surface.mode = dContactApprox1;
    contact.surface.mu = surfaces.friction;
    if (surfaces.movable != nullptr) {
      const Object& movable = *surfaces.movable;
      align_friction(contact, dGeomGetBody(a), dGeomGetBody(b), movable.rubbing);
      resist_rolling(contact, movable.rigid.body, movable.rubbing);
      contact.surface.mode |= dContactSoftCFM;
      contact.surface.soft_cfm = movable.rubbing.softness;
      const dReal* n = contact.geom.normal;
      joined.push = joined.push + hal::Vec3{n[0], n[1], n[2]};
    }
    const dJointID joint = dJointCreateContact(world.dynamics(), world.contacts(), &contact);
    dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
  }
  return joined;
}

const Solid& solid_of(dGeomID geometry) {
  return *static_cast<const Solid*>(dGeomGetData(geometry));
}

void press(Object& movable, const hal::Vec3& push) {
  movable.rubbing.push = movable.rubbing.push + push;
}

ContactRecord& record_of(Contacts& contacts, Solid::Kind other) {
  if (other == Solid::Kind::kMovable) return contacts.movables;
  return other == Solid::Kind::kMote ? contacts.motes : contacts.robots;
}

bool is_awake(dBodyID body) { return body != nullptr && dBodyIsEnabled(body) != 0; }

}  // namespace

void ContactPass::run(hal::Time now) {
  now_ = now;
  if (!has_settled_) settle();
  forget();
  if (!Clearance::measures(objects_))
    for (const AwakeList::Member i : awake_.members()) zones_.place(i);
  if (clearance_.may_touch(objects_)) {
    dSpaceCollide(world_.space(), this, [](void* self, dGeomID a, dGeomID b) {
      static_cast<ContactPass*>(self)->touch(a, b);
    });
    touch_walls();
  }
  for (const AwakeList::Member i : awake_.members()) {
    const Object& object = *objects_[i];
    if (object.drivetrain != nullptr)
      object.drivetrain->touch_ground(world_);
    else
      stand_on_ground(object);
  }
}

ContactPass::~ContactPass() {
  if (!walls_are_apart_) return;  // then they are the space's
  for (const dGeomID wall : walls_) dGeomDestroy(wall);
}

/// Takes many walls out of the space, whose search takes time for all that is in it.
void ContactPass::settle() {
  has_settled_ = true;
  clearance_.settle();
  walls_are_apart_ = !clearance_.tree().is_empty();
  if (!walls_are_apart_) return;
  for (const dGeomID wall : walls_) dSpaceRemove(world_.space(), wall);
}

/// After the space, so that what was woken by a push meets walls in the same step.
void ContactPass::touch_walls() {
  if (!walls_are_apart_) return;
  for (const AwakeList::Member i : awake_.members()) {
    for (const dGeomID geometry : objects_[i]->geometries) {
      if (dGeomIsEnabled(geometry) == 0) continue;
      std::array<dReal, 6> bounds{};  // low and high x, y, z
      dGeomGetAABB(geometry, bounds.data());
      near_.clear();
      clearance_.tree().overlapping({{bounds[0], bounds[2]}, {bounds[1], bounds[3]}}, near_);
      for (const std::uint32_t wall : near_) touch(walls_[wall], geometry);
    }
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
  Touched& touched = touched_[object];
  Object& sleeper = *objects_[object];
  sleeper.rubbing.push = {};
  if (sleeper.awake() || sleeper.frozen) touched = {};
  const auto [wall, robot, mote, movable] = touched;  // in the order of Solid::Kind
  if (wall) ++sleeper.contacts.walls.steps;
  if (robot) ++sleeper.contacts.robots.steps;
  if (mote) ++sleeper.contacts.motes.steps;
  if (movable) ++sleeper.contacts.movables.steps;
  if (robot || mote || movable) ++sleeper.contacts.bodies.steps;
  return wall || robot || mote || movable;
}

/// Sleeping objects in contact wake each other in the same step, so these stay in the search.
void ContactPass::rest(std::size_t object) {
  const auto [wall, robot, mote, movable] = touched_[object];
  if (!Clearance::measures(objects_) && !robot && !mote && !movable) zones_.rest(object);
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
  const double friction = std::min(solid_a.friction, solid_b.friction);
  const Joined joined = join(world_, a, b, {friction, movable_of(solid_a, solid_b)});
  if (joined.contacts == 0) return;
  deepest_ = std::max(deepest_, joined.depth);
  record(solid_a, solid_b);
  record(solid_b, solid_a);
  count(solid_a, solid_b, joined.contacts);
  if (solid_a.kind == Solid::Kind::kMovable) press(*objects_[solid_a.object], joined.push);
  if (solid_b.kind == Solid::Kind::kMovable) press(*objects_[solid_b.object], -1 * joined.push);
}

/// The one that may roll, or else any; null: neither is a movable.
const Object* ContactPass::movable_of(const Solid& a, const Solid& b) const {
  const Object* chosen = nullptr;
  for (const Solid& one : {a, b}) {
    if (one.kind != Solid::Kind::kMovable) continue;
    const Object* const object = objects_[one.object].get();
    if (chosen == nullptr || chosen->rubbing.rolling == 0) chosen = object;
  }
  return chosen;
}

void ContactPass::record(const Solid& self, const Solid& other) {
  if (self.kind == Solid::Kind::kWall) return;
  Object& object = *objects_[self.object];
  if (!object.awake()) object.wake();
  awake_.add(self.object);
  Touched& touched = touched_[self.object];
  bool& known = touched[static_cast<std::size_t>(other.kind)];
  if (known) return;
  const bool first_body = !touched[static_cast<std::size_t>(Solid::Kind::kRobot)] &&
                          !touched[static_cast<std::size_t>(Solid::Kind::kMote)] &&
                          !touched[static_cast<std::size_t>(Solid::Kind::kMovable)];
  if (touched == Touched{}) touching_.push_back(self.object);
  known = true;
  Contacts& contacts = object.contacts;
  if (other.kind == Solid::Kind::kWall) return note(contacts.walls);
  note(record_of(contacts, other.kind));
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

void ContactPass::stand_on_ground(const Object& object) {
  if (!object.awake()) return;
  const Surfaces surfaces{std::min(object.friction, ground_friction_),
                          object.movable ? &object : nullptr};
  for (const dGeomID geometry : object.geometries) {
    const dReal* p = dGeomGetPosition(geometry);
    join(world_, geometry, world_.ground_plane({p[0], p[1]}), surfaces);
  }
}

}  // namespace sim::physics
