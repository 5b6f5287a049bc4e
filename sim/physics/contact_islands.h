#pragma once

#include <cstddef>
#include <span>
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

  /// Adds an object; its number is the number of objects before. Its contacts are empty.
  void add_object(bool is_robot);

  /// Removes all contacts, at a cost proportional to their number.
  void reset();

  /// Adds contacts of an object with something that does not move.
  void add(std::size_t object, int contacts);

  /// Adds contacts between two objects.
  void join(std::size_t a, std::size_t b, int contacts);

  /// Whether there have been no contacts since reset().
  bool empty() const { return touching_.empty(); }

  /// The objects with contacts since reset(), in no particular order.
  std::span<const std::size_t> touching() const { return touching_; }

  /// Totals of the group to which an object belongs.
  Total total(std::size_t object);

 private:
  struct Member {
    std::size_t parent = 0;
    Total total;  ///< Valid at roots.
    bool is_robot = false;
    bool touches = false;
  };

  void note(std::size_t object);
  std::size_t root(std::size_t object);

  std::vector<Member> members_;
  std::vector<std::size_t> touching_;
};

}  // namespace sim::physics
