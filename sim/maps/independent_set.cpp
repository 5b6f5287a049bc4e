#include "sim/maps/independent_set.h"

#include <limits>

namespace sim::maps {
namespace {

constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

class Matching {
 public:
  explicit Matching(const Conflicts& conflicts)
      : first_(conflicts.left + 1, 0),
        partner_of_left_(conflicts.left, kNobody),
        partner_of_right_(conflicts.right, kNobody),
        depth_(conflicts.left) {
    for (const auto& [left, right] : conflicts.pairs) {
      ++first_[left + 1];
      others_.push_back(right);
    }
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  }

  void grow() {
    while (layer()) {
      next_ = first_;
      for (std::uint32_t left = 0; left < partner_of_left_.size(); ++left)
        if (partner_of_left_[left] == kNobody) augment(left);
    }
  }

  /// What no alternating path from an unmatched left member reaches on the left, and what it
  /// reaches on the right, touches every conflict. The others are the set.
  Chosen rest() {
    layer();
    Chosen chosen{std::vector<bool>(partner_of_left_.size()),
                  std::vector<bool>(partner_of_right_.size(), true)};
    for (std::uint32_t left = 0; left < depth_.size(); ++left) {
      if (depth_[left] == kNobody) continue;
      chosen.left[left] = true;
      for (std::uint32_t i = first_[left]; i < first_[left + 1]; ++i)
        chosen.right[others_[i]] = false;
    }
    return chosen;
  }

 private:
  /// Depths of left members on shortest alternating paths from unmatched ones. @return whether one
  /// of these ends at an unmatched right member
  bool layer() {
    std::vector<std::uint32_t> queue;
    for (std::uint32_t left = 0; left < depth_.size(); ++left) {
      depth_[left] = partner_of_left_[left] == kNobody ? 0 : kNobody;
      if (depth_[left] == 0) queue.push_back(left);
    }
    bool ends = false;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const std::uint32_t left = queue[i];
      for (std::uint32_t k = first_[left]; k < first_[left + 1]; ++k) {
        const std::uint32_t next = partner_of_right_[others_[k]];
        if (next == kNobody) {
          ends = true;
        } else if (depth_[next] == kNobody) {
          depth_[next] = depth_[left] + 1;
          queue.push_back(next);
        }
      }
    }
    return ends;
  }

  /// Depth first along the layers; on a stack of ours, as paths may be long.
  void augment(std::uint32_t start) {
    std::vector<std::uint32_t> path{start};
    while (!path.empty()) {
      const std::uint32_t left = path.back();
      if (next_[left] == first_[left + 1]) {
        depth_[left] = kNobody;  // a dead end
        path.pop_back();
        continue;
      }
      const std::uint32_t next = partner_of_right_[others_[next_[left]++]];
      if (next == kNobody) return flip(path);
      if (depth_[next] == depth_[left] + 1) path.push_back(next);
    }
  }

  /// Each member of the path takes the right member that it looked at last.
  void flip(const std::vector<std::uint32_t>& path) {
    for (const std::uint32_t left : path) {
      const std::uint32_t right = others_[next_[left] - 1];
      partner_of_left_[left] = right;
      partner_of_right_[right] = left;
    }
  }

  std::vector<std::uint32_t> first_;   ///< In others_, by left member.
  std::vector<std::uint32_t> others_;  ///< Right members.
  std::vector<std::uint32_t> partner_of_left_, partner_of_right_;
  std::vector<std::uint32_t> depth_;
  std::vector<std::uint32_t> next_;  ///< In others_, by left member: not yet looked at.
};

}  // namespace

Chosen independent_set(const Conflicts& conflicts) {
  Matching matching(conflicts);
  matching.grow();
  return matching.rest();
}

}  // namespace sim::maps
