#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/radio/phy/mode_id.h"

namespace sim::radio {

/// Packet error rate of one modulation and MCS, whatever the streams, width and guard interval, at
/// one SNR.
struct ErrorRow {
  ModulationClass modulation = ModulationClass::kOfdm;  ///< kOfdm or newer.
  std::uint8_t mcs = 0;                                 ///< As in ModeId.
  std::uint32_t size = 0;                               ///< Bytes of the packet, > 0.
  double snr_db = 0;                                    ///< Of a subcarrier.
  double per = 0;                                       ///< 0 .. 1
  bool operator==(const ErrorRow&) const = default;
};

/// The rows of one mode and size follow each other: two or more, in ascending order of SNR, none
/// with a higher error rate than the one before.
using ErrorTable = std::vector<ErrorRow>;

/// A row of a table that breaks these rules.
struct WrongRow {
  std::size_t row = 0;
  std::string what{};
};
std::vector<WrongRow> wrong_rows(const ErrorTable& table);

/// "HT7", "VHT9", "HE11", or "OFDM54" by the rate in Mb/s.
std::string name_of_mode(const ErrorRow& row);
/// All of these names, by class and MCS, with what they name in a row.
struct NamedMode {
  std::string name{};
  ModulationClass modulation = ModulationClass::kNone;
  std::uint8_t mcs = 0;
};
const std::vector<NamedMode>& modes_with_error_tables();

/// The success of packets of one mode by its rows.
///
/// Between two rows of a size the error rate is linear in the SNR in dB. Below the first row every
/// packet is lost, above the last one its error rate stays. A packet of another size has the error
/// rate 1 - (1 - p)^(L / L0), where p is that of the size L0 nearest to L by ratio (IEEE
/// 802.11-14/0571r12, 11ax Evaluation Methodology).
class ErrorCurve {
 public:
  /// @param rows  of one mode, with all its sizes; as wrong_rows() demands.
  explicit ErrorCurve(const ErrorTable& rows);

  /// Probability that all of `bits` bits arrive, a packet of their own.
  /// @param sinr  a ratio, not dB; >= 0, may be infinite.   @param bits  >= 0; fractions count.
  double success(double sinr, double bits) const;

 private:
  struct Point {
    double snr_db, per;
  };
  struct OfSize {
    double bits;
    std::vector<Point> points;
  };
  const OfSize& nearest(double bits) const;

  std::vector<OfSize> sizes_;  ///< Ascending.
};

/// The curve for the modulation and MCS of a mode; null if the table has none.
std::shared_ptr<const ErrorCurve> curve_of(const ErrorTable& table, const ModeId& mode);

}  // namespace sim::radio
