#pragma once

#include <string_view>

namespace hal::files::config {

/// Physical dimension. Values convert within one dimension only.
enum class Dimension {
  kNumber,
  kTime,
  kLength,
  kSpeed,
  kAcceleration,
  kAngle,
  kAngularSpeed,
  kAngularAcceleration,
  kMass,
  kInertia,
  kForce,
  kTorque,
  kVoltage,
  kResistance,
  kPower,
  kEnergy,
  kRatio,
  kAttenuation,
  kFrequency,
  kBitRate,
  kData,
};

/// A unit: value in the dimension's SI unit = number * up / down. Two exact factors instead of one
/// inexact factor give "10 ms" as the double nearest to 0.01.
struct Unit {
  std::string_view name;
  Dimension dimension = Dimension::kNumber;
  double up = 1;
  double down = 1;
  bool level = false;  ///< dBm: value = 1 mW * 10^(number / 10).
};

/// The unit with this name; null if there is none.
const Unit* find_unit(std::string_view name);

/// The SI unit of the same dimension.
const Unit& base_unit_of(const Unit& unit);

/// A number of `from` in units of `to`. @pre same dimension.
double converted(double number, const Unit& from, const Unit& to);

}  // namespace hal::files::config
