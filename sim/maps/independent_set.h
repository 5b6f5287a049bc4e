#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace sim::maps {

/// Conflicts between members of two sides, none of them within a side.
struct Conflicts {
  std::size_t left = 0, right = 0;                             ///< Number of members.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  ///< In ascending order.
};

/// Members of both sides.
struct Chosen {
  std::vector<bool> left, right;
};

/// The largest set of members without a conflict: all but a smallest set that touches every
/// conflict, which follows from a largest matching (D. Konig, 1931), found in
/// O(pairs sqrt(members)) (J. E. Hopcroft, R. M. Karp, SIAM Journal on Computing 2, 1973).
Chosen independent_set(const Conflicts& conflicts);

}  // namespace sim::maps
