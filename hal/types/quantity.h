#pragma once

#include <compare>

namespace hal {

/// A double that knows its unit. Same-unit values add, subtract and compare; nothing converts
/// silently. Products between units are written out in a named function that cites its formula.
template <class Unit>
struct Quantity {
  double value = 0.0;

  constexpr Quantity() = default;
  constexpr explicit Quantity(double v) : value(v) {}

  constexpr auto operator<=>(const Quantity&) const = default;
  friend constexpr Quantity operator+(Quantity a, Quantity b) {
    return Quantity{a.value + b.value};
  }
  friend constexpr Quantity operator-(Quantity a, Quantity b) {
    return Quantity{a.value - b.value};
  }
  friend constexpr Quantity operator*(double k, Quantity a) { return Quantity{k * a.value}; }
};

using Metres = Quantity<struct MetreTag>;
using Hertz = Quantity<struct HertzTag>;
using BitsPerSecond = Quantity<struct BitPerSecondTag>;
using Milliwatts = Quantity<struct MilliwattTag>;
using Decibels = Quantity<struct DecibelTag>;  ///< A ratio: gain (positive) or loss (negative).

/// Power level relative to 1 mW. A level is to Decibels what a time point is to a duration:
/// level + gain = level, level - level = gain, and level + level does not compile.
struct Dbm {
  double value = 0.0;
  constexpr Dbm() = default;
  constexpr explicit Dbm(double v) : value(v) {}
  constexpr auto operator<=>(const Dbm&) const = default;
  friend constexpr Dbm operator+(Dbm p, Decibels gain) { return Dbm{p.value + gain.value}; }
  friend constexpr Dbm operator-(Dbm p, Decibels loss) { return Dbm{p.value - loss.value}; }
  friend constexpr Decibels operator-(Dbm a, Dbm b) { return Decibels{a.value - b.value}; }
};

}  // namespace hal
