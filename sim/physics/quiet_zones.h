#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "sim/physics/object.h"

namespace sim::physics {

/// Removes the geometries of objects that sleep far from all awake objects from the search for
/// contacts, whose cost otherwise grows with the number of all objects. A contact wakes a sleeping
/// object, so it must be in the search when an awake object comes near. In square cells as wide as
/// the two largest objects, a sleeping object is in the search if anything is awake in its cell or
/// in one of the eight cells around it.
///
///   QuietZones zones(objects);
///   … in each step: zones.place(i) for each awake object i; search; solve; zones.rest(i) for each
///   object i that has fallen asleep …
class QuietZones {
 public:
  explicit QuietZones(Objects& objects) : objects_(objects) {}

  /// Updates the position of an awake object, before the search.
  void place(std::size_t object);

  /// Records that an object has fallen asleep.
  void rest(std::size_t object);

 private:
  using Cell = std::pair<std::int32_t, std::int32_t>;
  struct Zone {
    int awake = 0;
    std::vector<std::size_t> sleepers;
  };
  using Zones = std::map<Cell, Zone>;
  struct Member {
    Cell cell;
    bool is_placed = false;  ///< Counted as awake in its cell.
    bool sleeps = false;     ///< Among the sleepers of its cell.
  };

  void adopt();
  Cell cell_of(std::size_t object) const;
  void enter(const Cell& cell);
  void leave(const Cell& cell);
  void wake(std::size_t object);
  bool is_quiet(const Cell& middle) const;
  void drop_if_empty(Zones::iterator zone);
  void take_part(std::size_t object, bool does) const;

  Objects& objects_;
  double size_ = 0;  ///< m, edge of a cell.
  std::vector<Member> members_;
  Zones zones_;  ///< Zones without objects are removed.
};

}  // namespace sim::physics
