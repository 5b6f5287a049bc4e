#pragma once

#include <string>
#include <vector>

namespace sim::radio {

/// Random loss of frames that would otherwise be received, for testing the layers above.
struct LossConfig {
  /// A loss probability for certain directed links.
  struct Link {
    std::string from, to;    ///< Names of stations, or patterns (hal/types/pattern.h).
    double probability = 0;  ///< 0 .. 1.
    bool operator==(const Link&) const = default;
  };
  double probability = 0;   ///< 0 .. 1, for links that `links` does not name.
  std::vector<Link> links;  ///< The last one that matches applies.

  bool is_none() const { return probability <= 0 && links.empty(); }
};

}  // namespace sim::radio
