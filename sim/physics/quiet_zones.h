#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "sim/physics/object.h"

namespace sim::physics {

/// Takes the geometries of objects that sleep far from all that is awake out of the search for
/// contacts, whose cost else grows with everything there is. What sleeps is woken by a touch, so it
/// must be found by whatever comes near: in square cells as wide as the two largest objects, what
/// sleeps takes part if anything is awake in its cell or in one of the eight around.
///
///   QuietZones zones(objects);
///   … in each step: zones.place(i) of each i that is awake; search; solve; zones.rest(i) of each i
///   that has fallen asleep …
class QuietZones {
 public:
  explicit QuietZones(Objects& objects) : objects_(objects) {}

  /// An object is awake: where it is now, before the search.
  void place(std::size_t object);

  /// It sleeps from now on.
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
    bool is_placed = false;  ///< Counted as awake in its cell …
    bool sleeps = false;     ///< … or among the sleepers there.
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
  Zones zones_;  ///< None is empty.
};

}  // namespace sim::physics
