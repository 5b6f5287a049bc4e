#pragma once

#include <string>
#include <vector>

namespace sim::radio {

/// Frames that get lost although the physics would let them in, to see what is above do with it.
struct LossConfig {
  struct Link {
    std::string from, to;  ///< Names of stations, or patterns (hal/types/pattern.h).
    double probability = 0;
    bool operator==(const Link&) const = default;
  };
  double probability = 0;   ///< 0 .. 1, on every link that `links` does not name.
  std::vector<Link> links;  ///< Of several that fit the last one counts.

  bool is_none() const { return probability <= 0 && links.empty(); }
};

}  // namespace sim::radio
