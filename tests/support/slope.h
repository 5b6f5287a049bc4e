#pragma once

#include <cmath>

#include "sim/core/ground.h"

namespace tests {

/// A plane that climbs along x.
class Slope final : public sim::Ground {
 public:
  /// @param foot  m, height at x = 0. @param grade  m of climb per m of x, seen from above.
  Slope(double foot, double grade) : foot_(foot), grade_(grade) {}

  /// Lets it give way by some m, from now on.
  void sink(double depth) { foot_ -= depth; }

  double height(hal::Vec2 at) const override { return foot_ + grade_ * at.x; }
  hal::Vec3 normal(hal::Vec2 /*at*/) const override {
    return (1 / std::sqrt(1 + grade_ * grade_)) * hal::Vec3{-grade_, 0, 1};
  }

 private:
  double foot_, grade_;
};

}  // namespace tests
