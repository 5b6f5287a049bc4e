#pragma once

#include <cstddef>
#include <vector>

namespace sim::physics {

/// Groups objects that touch each other and counts the contacts of each group: a disjoint-set
/// forest (R. E. Tarjan, "Efficiency of a Good But Not Linear Set Union Algorithm", 1975) whose
/// roots are the smallest members, so that the result does not depend on the order of contacts.
class ContactIslands {
 public:
  struct Total {
    int contacts = 0;
    int robots = 0;
  };

  /// Forgets everything; objects are 0 .. count-1, each on its own and none a robot.
  void reset(std::size_t count);

  /// @pre once per object, before its first contact.
  void mark_robot(std::size_t object) { totals_[object].robots = 1; }

  /// Contacts of an object with something that does not move.
  void add(std::size_t object, int contacts);

  /// Contacts between two objects.
  void join(std::size_t a, std::size_t b, int contacts);

  /// Whether nothing has touched anything since reset().
  bool empty() const { return empty_; }

  /// Of the group that an object belongs to.
  Total total(std::size_t object);

 private:
  std::size_t root(std::size_t object);

  std::vector<std::size_t> parents_;
  std::vector<Total> totals_;  ///< Valid at roots.
  bool empty_ = true;
};

}  // namespace sim::physics
