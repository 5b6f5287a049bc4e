#pragma once

#include <compare>

namespace hal {

/// A double with a unit in its type. Values of the same unit add, subtract and compare; there are
/// no implicit conversions. Products of units are named functions that cite their formula.
template <class Unit>
struct Quantity {
  double value = 0.0;  ///< In the unit of the type.

  /// Zero.
  constexpr Quantity() = default;
  /// `v` of the unit.
  constexpr explicit Quantity(double v) : value(v) {}

  constexpr auto operator<=>(const Quantity&) const = default;  ///< Member by member.
  /// Sum, in the same unit.
  friend constexpr Quantity operator+(Quantity a, Quantity b) {
    return Quantity{a.value + b.value};
  }
  /// Difference, in the same unit.
  friend constexpr Quantity operator-(Quantity a, Quantity b) {
    return Quantity{a.value - b.value};
  }
  /// k times the quantity, in the same unit.
  friend constexpr Quantity operator*(double k, Quantity a) { return Quantity{k * a.value}; }
};

using Metres = Quantity<struct MetreTag>;                ///< Length, m.
using Hertz = Quantity<struct HertzTag>;                 ///< Frequency or bandwidth, Hz.
using BitsPerSecond = Quantity<struct BitPerSecondTag>;  ///< Data rate, bit/s.
using Milliwatts = Quantity<struct MilliwattTag>;        ///< Power, mW.
using Decibels = Quantity<struct DecibelTag>;            ///< Ratio, dB: gain > 0, loss < 0.

/// Power level relative to 1 mW. A level is to Decibels what a time point is to a duration:
/// level + gain = level, level - level = gain, and level + level does not compile.
struct Dbm {
  double value = 0.0;  ///< dB relative to 1 mW.
  /// 0 dBm, that is 1 mW.
  constexpr Dbm() = default;
  /// `v` dBm.
  constexpr explicit Dbm(double v) : value(v) {}
  constexpr auto operator<=>(const Dbm&) const = default;  ///< Member by member.
  /// Level after a gain.
  friend constexpr Dbm operator+(Dbm p, Decibels gain) { return Dbm{p.value + gain.value}; }
  /// Level after a loss.
  friend constexpr Dbm operator-(Dbm p, Decibels loss) { return Dbm{p.value - loss.value}; }
  /// Ratio of two powers.
  friend constexpr Decibels operator-(Dbm a, Dbm b) { return Decibels{a.value - b.value}; }
};

}  // namespace hal
