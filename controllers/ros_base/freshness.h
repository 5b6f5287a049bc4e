#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "hal/types/time.h"

namespace controllers {

/// Which of the readings that a channel holds at each control cycle are new. A channel does not say
/// so: those with other values are, and equal ones once per period.
class Freshness {
 public:
  /// @param period  of the channel; zero: every reading is new.
  explicit Freshness(hal::Duration period) : period_(period) {}

  bool is_new(std::span<const double> values, hal::Time now) {
    if (!due_ || !std::ranges::equal(values, last_, is_same)) {
      due_ = now + period_;
    } else if (now >= *due_) {
      *due_ = std::max(*due_ + period_, now);
    } else {
      return false;
    }
    last_.assign(values.begin(), values.end());
    return true;
  }

 private:
  static bool is_same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

  const hal::Duration period_;
  std::optional<hal::Time> due_;  ///< Then equal values are taken for a new reading.
  std::vector<double> last_;
};

}  // namespace controllers
