#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <variant>
#include <vector>

#include "hal/types/geometry.h"
#include "hal/types/math.h"
#include "hal/types/quantity.h"

namespace sim::radio {

/// Equal in all directions.
struct OmniAntenna {
  static constexpr std::string_view kPattern = "omni";
  bool operator==(const OmniAntenna&) const = default;
};

/// Half-wave dipole along the body's z axis.
struct DipoleAntenna {
  static constexpr std::string_view kPattern = "dipole";
  bool operator==(const DipoleAntenna&) const = default;
};

/// One main lobe; its gain at boresight is the station's antenna gain.
struct BeamAntenna {
  static constexpr std::string_view kPattern = "beam";
  double width = hal::math::kPi / 3;   ///< rad, > 0, half-power beam width in azimuth.
  double height = hal::math::kPi / 3;  ///< rad, > 0, half-power beam width in elevation.
  double azimuth = 0;                  ///< rad, of boresight in the body's frame.
  double elevation = 0;                ///< rad, upwards.
  hal::Decibels back{20};              ///< > 0: no direction is weaker than boresight by more.
  bool operator==(const BeamAntenna&) const = default;
};

/// Gain in one direction of the body's frame.
struct AntennaRow {
  double azimuth = 0;    ///< deg, from the x axis towards the y axis, -180 .. 360.
  double elevation = 0;  ///< deg, from the x-y plane towards the z axis, -90 .. 90.
  double gain = 0;       ///< dBi
  bool operator==(const AntennaRow&) const = default;
};

/// Measured or computed gains.
struct TableAntenna {
  static constexpr std::string_view kPattern = "table";
  std::vector<AntennaRow> rows;  ///< A grid, as wrong_row() demands.
  bool operator==(const TableAntenna&) const = default;
};

using AntennaConfig = std::variant<OmniAntenna, DipoleAntenna, BeamAntenna, TableAntenna>;

/// A row that keeps the rows from being a grid: each elevation must have each azimuth once.
struct WrongAntennaRow {
  std::size_t row = 0;
  std::string_view what{};
};
std::vector<WrongAntennaRow> wrong_rows(const std::vector<AntennaRow>& rows);

/// Gain by direction, in the frame of the body that carries the antenna: x ahead, y to the left, z
/// upwards. The same for transmission and reception.
///
/// dipole: 1.641 (cos(pi / 2 cos t) / sin t)^2 at the angle t from its axis (C. A. Balanis,
/// "Antenna Theory", 3rd ed., 4.6). beam: -min(12 (a / width)^2 + 12 (e / height)^2, back) dB, a
/// and e azimuth and elevation from boresight (3GPP TR 36.814 V9.0.0, table A.2.1.1-2, with one
/// limit for all). table: linear in dB between the four nearest rows; azimuths go round, elevations
/// beyond the first or last row have its gain. No direction is below -100 dB.
class AntennaPattern {
 public:
  explicit AntennaPattern(const AntennaConfig& config);

  /// A ratio. @param direction  body frame, of any length > 0.
  double towards(const hal::Vec3& direction) const;
  double most() const { return most_; }

 private:
  double of(const OmniAntenna&, const hal::Vec3&) const { return 1; }
  double of(const DipoleAntenna&, const hal::Vec3& direction) const;
  double of(const BeamAntenna& beam, const hal::Vec3& direction) const;
  double of(const TableAntenna&, const hal::Vec3& direction) const;
  void arrange(const TableAntenna& table);

  AntennaConfig config_;
  std::vector<double> azimuths_, elevations_;  ///< rad, of the table, ascending.
  std::vector<double> decibels_;               ///< By elevation, then azimuth.
  double most_ = 1;
};

/// Turns a body's frame into that of the world: a unit quaternion, w, x, y, z.
using Attitude = std::array<double, 4>;

/// An antenna that is not equal in all directions, on a body.
class DirectedAntenna {
 public:
  DirectedAntenna(AntennaPattern pattern, const Attitude& attitude)
      : pattern_(std::move(pattern)), attitude_(attitude) {}

  /// @return whether it has turned.
  bool turn(const Attitude& attitude) {
    if (attitude == attitude_) return false;
    attitude_ = attitude;
    return true;
  }
  /// A ratio. @param way  world frame; zero: the direction is not known, and the gain is 1.
  double towards(const hal::Vec3& way) const;

 private:
  AntennaPattern pattern_;
  Attitude attitude_;
};

}  // namespace sim::radio
