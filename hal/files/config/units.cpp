#include "hal/files/config/units.h"

#include <algorithm>
#include <array>

#include "hal/types/check.h"
#include "hal/types/math.h"

namespace hal::files::config {
namespace {

using math::kPi;
using enum Dimension;

/// BIPM, "The International System of Units (SI)", 9th edition, 2019, with the non-SI units that
/// are usual in radio and robotics.
constexpr std::array kUnits = {
    Unit{"1", kNumber},
    Unit{"%", kNumber, 1, 1e2},
    Unit{"s", kTime},
    Unit{"ms", kTime, 1, 1e3},
    Unit{"us", kTime, 1, 1e6},
    Unit{"ns", kTime, 1, 1e9},
    Unit{"min", kTime, 60},
    Unit{"h", kTime, 3600},
    Unit{"m", kLength},
    Unit{"mm", kLength, 1, 1e3},
    Unit{"cm", kLength, 1, 1e2},
    Unit{"km", kLength, 1e3},
    Unit{"m/s", kSpeed},
    Unit{"km/h", kSpeed, 1e3, 3600},
    Unit{"m/s^2", kAcceleration},
    Unit{"rad", kAngle},
    Unit{"deg", kAngle, math::kPi, 180},
    Unit{"rad/s", kAngularSpeed},
    Unit{"deg/s", kAngularSpeed, math::kPi, 180},
    Unit{"rpm", kAngularSpeed, 2 * math::kPi, 60},
    Unit{"rad/s^2", kAngularAcceleration},
    Unit{"deg/s^2", kAngularAcceleration, math::kPi, 180},
    Unit{"kg", kMass},
    Unit{"g", kMass, 1, 1e3},
    Unit{"kg m^2", kInertia},
    Unit{"N", kForce},
    Unit{"J/m", kForce},
    Unit{"N m", kTorque},
    Unit{"Nm", kTorque},
    Unit{"V", kVoltage},
    Unit{"mV", kVoltage, 1, 1e3},
    Unit{"ohm", kResistance},
    Unit{"mohm", kResistance, 1, 1e3},
    Unit{"W", kPower},
    Unit{"mW", kPower, 1, 1e3},
    Unit{"uW", kPower, 1, 1e6},
    Unit{"dBm", kPower, 1, 1e3, true},
    Unit{"J", kEnergy},
    Unit{"mJ", kEnergy, 1, 1e3},
    Unit{"kJ", kEnergy, 1e3},
    Unit{"Wh", kEnergy, 3600},
    Unit{"dB", kRatio},
    Unit{"dB/m", kAttenuation},
    Unit{"Hz", kFrequency},
    Unit{"kHz", kFrequency, 1e3},
    Unit{"MHz", kFrequency, 1e6},
    Unit{"GHz", kFrequency, 1e9},
    Unit{"b/s", kBitRate},
    Unit{"kb/s", kBitRate, 1e3},
    Unit{"Mb/s", kBitRate, 1e6},
    Unit{"Gb/s", kBitRate, 1e9},
    Unit{"B", kData},
    Unit{"kB", kData, 1e3},
    Unit{"MB", kData, 1e6},
};

}  // namespace

const Unit* find_unit(std::string_view name) {
  const auto* const found = std::find_if(kUnits.begin(), kUnits.end(),
                                         [name](const Unit& unit) { return unit.name == name; });
  return found == kUnits.end() ? nullptr : &*found;
}

const Unit& base_unit_of(const Unit& unit) {
  // Each dimension is listed with its SI unit first.
  return *std::find_if(kUnits.begin(), kUnits.end(),
                       [&](const Unit& other) { return other.dimension == unit.dimension; });
}

double converted(double number, const Unit& from, const Unit& to) {
  BARAKA_CHECK(from.dimension == to.dimension);
  if (from.name == to.name) return number;
  if (from.level) number = math::pow(10.0, number / 10.0);
  const double scaled = number * (from.up * to.down) / (from.down * to.up);
  return to.level ? 10.0 * math::log10(scaled) : scaled;
}

}  // namespace hal::files::config
