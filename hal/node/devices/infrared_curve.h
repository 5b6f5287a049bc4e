#pragma once

#include <vector>

namespace hal::node::devices {

/// One point of a measured sensor curve.
struct CurvePoint {
  double metres = 0;
  double volts = 0;
  bool operator==(const CurvePoint&) const = default;
};

/// Output voltage of a triangulating infrared ranger as a function of distance, and its inverse.
///
///   volts
///     |    /\            below min_range the output falls to 0 again, so near looks like far, as
///     on |   /  \__         the real sensor; beyond max_range it falls as 1/distance to
///     kFloorVolts |  /      \____
///     +--min------max--- metres
class InfraredCurve {
 public:
  /// Output of the sensor when nothing reflects.
  static constexpr double kFloorVolts = 0.2;

  /// volts = scale * (gain / (metres + offset) + bias).
  struct Hyperbola {
    double scale = 0;   ///< V
    double gain = 0;    ///< m
    double offset = 0;  ///< m
    double bias = 0;    ///< 1
    bool operator==(const Hyperbola&) const = default;
  };

  /// Sharp GP2D12, 0.10 .. 0.80 m: counts = 6787 / (d[cm] + 4) + 3 of a 10-bit converter at 5 V;
  /// within the limits of the data sheet (Sharp, "GP2D12/GP2D15", 1999: 0.25 .. 0.55 V at 80 cm,
  /// 1.75 .. 2.25 V between 10 and 80 cm).
  static InfraredCurve gp2d12();

  /// Sharp GP2D120, 0.04 .. 0.30 m: counts = 2914 / (d[cm] + 1) - 5 of the same converter.
  static InfraredCurve gp2d120();

  /// Linear interpolation between measured points.
  /// @param points  at least two; metres > 0 ascending, volts > kFloorVolts descending.
  /// @throws std::invalid_argument naming the point that is out of order.
  static InfraredCurve table(std::vector<CurvePoint> points);

  double min_range() const { return min_range_; }  ///< m; the curve peaks here.
  double max_range() const { return max_range_; }  ///< m; the largest specified range.

  /// Distance [m] at which the output reaches kFloorVolts; surfaces farther away have no effect.
  double reach() const;

  /// @param metres  >= 0; infinity: nothing reflects. @return V, without noise.
  double volts(double metres) const;

  /// Distance [m] for an output voltage: min_range() at or above the peak, NaN below the output at
  /// max_range() (nothing within range).
  double metres(double volts) const;

  /// The points of a table(); empty if the curve is a formula.
  const std::vector<CurvePoint>& points() const { return points_; }

  bool operator==(const InfraredCurve&) const = default;

 private:
  InfraredCurve(double min_range, double max_range)
      : min_range_(min_range), max_range_(max_range) {}
  double volts_inside(double metres) const;
  double metres_inside(double volts) const;

  double min_range_;
  double max_range_;
  Hyperbola hyperbola_;
  std::vector<CurvePoint> points_;  ///< Empty: hyperbola_ is used.
};

/// Analog-to-digital converter with an ideal, rounding characteristic.
struct Converter {
  int bits = 10;            ///< 1 .. 24; 0: no quantisation.
  double full_scale = 5.0;  ///< V at the highest count.

  /// The nearest voltage that the converter can represent, within 0 .. full_scale.
  double quantise(double volts) const;
  bool operator==(const Converter&) const = default;
};

}  // namespace hal::node::devices
