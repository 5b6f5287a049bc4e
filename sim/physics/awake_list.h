#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace sim::physics {

/// The objects that may be awake, so that the cost of a step depends on the number of moving
/// objects and not of all. Code that wakes an object adds it; code that finds a listed object
/// asleep removes it. Objects are numbers from 0.
class AwakeList {
 public:
  using Member = std::uint32_t;

  /// Adds an object in constant time. No effect if it is listed already.
  void add(std::size_t object) {
    if (object >= is_there_.size()) is_there_.resize(object + 1, 0);
    if (is_there_[object] != 0) return;
    is_there_[object] = 1;
    added_.push_back(static_cast<Member>(object));
  }

  /// The listed objects in ascending order: contacts are made in the order of objects, and the
  /// solver works in the order of contacts. Valid until the list changes.
  std::span<const Member> members() {
    if (added_.empty()) return members_;
    std::ranges::sort(added_);
    const auto old = static_cast<std::ptrdiff_t>(members_.size());
    members_.insert(members_.end(), added_.begin(), added_.end());
    std::inplace_merge(members_.begin(), members_.begin() + old, members_.end());
    added_.clear();
    return members_;
  }

  /// Removes the objects for which keep(object) is false; calls it in ascending order.
  template <class Keep>
  void keep_if(Keep keep) {
    members();
    std::erase_if(members_, [&](Member object) {
      const bool stays = keep(object);
      if (!stays) is_there_[object] = 0;
      return !stays;
    });
  }

 private:
  std::vector<Member> members_;  ///< In ascending order.
  std::vector<Member> added_;    ///< Not in members_ yet.
  std::vector<std::uint8_t> is_there_;
};

}  // namespace sim::physics
