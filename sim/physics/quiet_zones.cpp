#include "sim/physics/quiet_zones.h"

#include <algorithm>
#include <cmath>

namespace sim::physics {
namespace {

constexpr double kSmallestCell = 1;  // m; so that objects change cells rarely
constexpr double kLastCell = 1e9;    // farther out than any body gets

std::int32_t number_of(double coordinate, double size) {
  const double number = std::floor(coordinate / size);
  // Written so that NaN gets a cell, too.
  return number > -kLastCell && number < kLastCell ? static_cast<std::int32_t>(number) : 0;
}

/// Calls act(cell) for a cell and the eight around it.
template <class Cell, class Act>
void for_each_around(const Cell& middle, Act act) {
  for (std::int32_t column = middle.first - 1; column <= middle.first + 1; ++column)
    for (std::int32_t row = middle.second - 1; row <= middle.second + 1; ++row)
      act(Cell{column, row});
}

}  // namespace

/// Adds the objects that are not members yet. @pre none is added after the first step.
void QuietZones::adopt() {
  for (std::size_t i = members_.size(); i < objects_.size(); ++i)
    size_ = std::max({size_, kSmallestCell, 2 * radius_of(*objects_[i])});
  members_.resize(objects_.size());
}

QuietZones::Cell QuietZones::cell_of(std::size_t object) const {
  const dReal* p = dBodyGetPosition(objects_[object]->rigid.body);
  return {number_of(p[0], size_), number_of(p[1], size_)};
}

void QuietZones::place(std::size_t object) {
  if (members_.size() != objects_.size()) adopt();
  Member& member = members_[object];
  const Cell cell = cell_of(object);
  if (member.is_placed && member.cell == cell) return;
  if (member.sleeps) wake(object);
  // Enters the new cell before leaving the old one, so that objects near both stay in the search.
  enter(cell);
  if (member.is_placed) leave(member.cell);
  member = {cell, true, false};
}

void QuietZones::rest(std::size_t object) {
  Member& member = members_[object];
  const Cell before = member.cell;
  member = {cell_of(object), false, true};
  zones_[member.cell].sleepers.push_back(object);
  leave(before);
  if (is_quiet(member.cell)) take_part(object, false);
}

void QuietZones::wake(std::size_t object) {
  const auto zone = zones_.find(members_[object].cell);
  std::erase(zone->second.sleepers, object);
  drop_if_empty(zone);
  take_part(object, true);
}

void QuietZones::enter(const Cell& cell) {
  if (zones_[cell].awake++ > 0) return;
  for_each_around(cell, [this](const Cell& near) {
    const auto zone = zones_.find(near);
    if (zone == zones_.end()) return;
    for (const std::size_t sleeper : zone->second.sleepers) take_part(sleeper, true);
  });
}

void QuietZones::leave(const Cell& cell) {
  const auto left = zones_.find(cell);
  if (--left->second.awake > 0) return;
  for_each_around(cell, [this](const Cell& near) {
    const auto zone = zones_.find(near);
    if (zone == zones_.end() || zone->second.sleepers.empty() || !is_quiet(near)) return;
    for (const std::size_t sleeper : zone->second.sleepers) take_part(sleeper, false);
  });
  drop_if_empty(left);
}

bool QuietZones::is_quiet(const Cell& middle) const {
  bool is_quiet = true;
  for_each_around(middle, [&](const Cell& near) {
    const auto zone = zones_.find(near);
    is_quiet = is_quiet && (zone == zones_.end() || zone->second.awake == 0);
  });
  return is_quiet;
}

void QuietZones::drop_if_empty(Zones::iterator zone) {
  if (zone->second.awake == 0 && zone->second.sleepers.empty()) zones_.erase(zone);
}

void QuietZones::take_part(std::size_t object, bool does) const {
  if (objects_[object]->frozen) return;  // permanently out of the search
  for (const dGeomID geometry : objects_[object]->geometries)
    does ? dGeomEnable(geometry) : dGeomDisable(geometry);
}

}  // namespace sim::physics
