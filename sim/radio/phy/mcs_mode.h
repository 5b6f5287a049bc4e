#pragma once

#include <memory>

#include "sim/radio/phy/coding.h"
#include "sim/radio/phy/error_table.h"
#include "sim/radio/phy/phy_mode.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

/// Constellation and code rate of an MCS, the same in HT (modulo 8), VHT and HE (IEEE Std
/// 802.11-2020, tables 19-27 and 21-30; IEEE Std 802.11ax-2021, table 27-55 ff.). @pre mcs <= 11.
Coding mcs_coding(std::uint8_t mcs);

/// The common part of HT, VHT and HE: after the legacy preamble of 16 us, a header that begins with
/// L-SIG and ends where the data field begins, then symbols for 16 service bits, the PSDU and 6
/// tail bits per encoder.
///
/// Streams are independent: a receiver has as many antennas as there are streams, so that each has
/// the whole SINR, as in ns-3. The header counts as bits in BPSK 1/2 spread evenly over its time:
/// its training fields have none. The SINR in a width is the same in each 20 MHz, which carry
/// copies of the header up to the first training field; a receiver gains nothing by combining them.
class McsMode : public PhyMode {
 public:
  struct Options {
    BitsAtRisk at_risk = BitsAtRisk::kMpdu;
    bool has_extension = true;  ///< In 2.4 GHz: 6 us of signal extension after the last symbol.
    PpduTimes times = PpduTimes::kStandard;
    std::shared_ptr<const ErrorCurve> curve{};  ///< Null: ofdm_success_probability().
  };

  hal::BitsPerSecond reference_rate() const final;
  bool is_mandatory() const final;
  hal::Duration signal_extension() const final;
  double bits_at_risk(std::uint32_t psdu_bits) const final;
  hal::Duration airtime(std::uint32_t psdu_bits) const final;
  hal::Duration longest_ppdu() const final;
  double header_success(double sinr, double share) const final;
  double success(double sinr, double bits) const final;

 protected:
  /// What the formats differ in.
  struct Format {
    hal::Duration header{};  ///< From L-SIG to the data field.
    double header_bits = 0;
    hal::Duration symbol{};    ///< With the guard interval.
    int data_subcarriers = 0;  ///< N_SD
    int encoders = 1;          ///< N_ES
    /// The data field lasts a multiple of this.
    hal::Duration multiple{};
  };
  McsMode(const ModeId& id, const Format& format, const Options& options);

  /// Coded bits of a symbol, N_CBPS.
  static int coded_bits(const ModeId& id, int data_subcarriers);
  /// Training fields for as many streams: 1, 2, 4, 4.
  static int training_fields(const ModeId& id);

 private:
  hal::Duration extension() const;

  Format format_;
  Options options_;
  Coding coding_;
  std::int64_t bits_per_symbol_;  ///< N_DBPS
};

}  // namespace sim::radio
