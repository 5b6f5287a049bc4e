#pragma once

#include <string>
#include <vector>

namespace sim::radio {

/// Random loss of frames that the physics would deliver, to test the layers above.
struct LossConfig {
  /// A directed link with a probability of its own.
  struct Link {
    std::string from, to;    ///< Names of stations, or patterns (hal/types/pattern.h).
    double probability = 0;  ///< 0 .. 1.
    bool operator==(const Link&) const = default;
  };
  double probability = 0;   ///< 0 .. 1, on every link that `links` does not name.
  std::vector<Link> links;  ///< The last one that matches applies.

  bool is_none() const { return probability <= 0 && links.empty(); }
};

}  // namespace sim::radio
