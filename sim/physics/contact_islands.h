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

  /// One more object: its number is how many there were before. No contacts are known.
  void add_object(bool is_robot);

  /// Forgets all contacts. Costs as much as there were.
  void reset();

  /// Contacts of an object with something that does not move.
  void add(std::size_t object, int contacts);

  /// Contacts between two objects.
  void join(std::size_t a, std::size_t b, int contacts);

  /// Whether nothing has touched anything since reset().
  bool empty() const { return touching_.empty(); }

  /// Those that have touched something since reset(), in no order.
  std::span<const std::size_t> touching() const { return touching_; }

  /// Of the group that an object belongs to.
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
