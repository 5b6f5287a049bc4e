#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "hal/types/quantity.h"
#include "hal/types/time.h"

namespace sim::radio {

using namespace std::chrono_literals;

enum class Profile : std::uint8_t {
  kMobilityFramework,  ///< The paper's: replica of the Mobility Framework 1.0a5 NIC.
  kIeee80211b,         ///< IEEE Std 802.11-2016, clauses 10 and 16: DSSS and HR/DSSS.
  kDisk,               ///< A range and a bit rate, no MAC.
  kIdeal,              ///< Instant and lossless.
};

enum class Lengths : std::uint8_t {
  kBytes,  ///< What the codec would put on the air.
  kFixed,  ///< `fixed_header_bits` and `fixed_payload_bits`, whatever the frame carries.
};
enum class Rounding : std::uint8_t {
  kExact,        ///< To the nearest nanosecond per frame.
  kMicrosecond,  ///< Payload up to whole microseconds (IEEE Std 802.11-2016, 16.3.4: TXTIME).
};
enum class ErrorModel : std::uint8_t { kMobilityFramework, kDsss };
enum class Preamble : std::uint8_t { kLong, kShort };

/// One radio profile with every key resolved. profile_defaults() gives each profile's values; a
/// radio file may set any key that the profile uses. "mf": mobility_framework, "b": ieee80211b;
/// no mark: both of them. disk and ideal use `range`, `lengths` and the two fixed lengths; disk
/// also `data_rate`, `queue_limit` and `tx_power` (for the energy only); nothing else.
struct RadioConfig {
  Profile profile = Profile::kIeee80211b;

  // Propagation and noise.
  hal::Milliwatts tx_power{2};       ///< > 0.
  hal::Metres wavelength{0.125};     ///< > 0.
  double path_loss_exponent = 2;     ///< Friis power law, reference 1 m; >= 1.
  bool propagation_delay = false;    ///< Distance over 299792458 m/s.
  bool obstacles = false;            ///< Walls attenuate.
  hal::Dbm sensitivity{-85};         ///< Weaker frames cannot be received …
  hal::Dbm interference_floor{-85};  ///< … and weaker than this do not exist. <= sensitivity.
  hal::Dbm noise_floor{-110};        ///< Thermal noise and noise figure in the bandwidth.
  hal::Dbm cca_threshold{-85};       ///< Carrier sense: a frame present.
  hal::Dbm energy_detection{-85};    ///< Carrier sense: sum of all frames.

  // PHY. Rates: 1, 2, 5.5 or 11 Mb/s.
  hal::BitsPerSecond data_rate{11e6};
  hal::BitsPerSecond control_rate{11e6};  ///< RTS, CTS, ACK.
  hal::BitsPerSecond broadcast_rate{11e6};
  Preamble preamble = Preamble::kLong;  ///< kShort: not for frames at 1 Mb/s.
  Rounding rounding = Rounding::kExact;
  Lengths lengths = Lengths::kFixed;
  std::uint32_t fixed_header_bits = 272;  ///< kFixed: MAC header and FCS of a data frame.
  std::uint32_t fixed_payload_bits = 0;   ///< kFixed: a network packet.
  ErrorModel error_model = ErrorModel::kMobilityFramework;
  /// Lowest usable SINR. kMobilityFramework: over the whole frame, below or equal is a collision.
  /// kDsss: of the preamble, below it the receiver does not synchronise.
  hal::Decibels min_sinr{4};
  /// The receiver takes the strongest of the frames that start within this time of the first one.
  /// Zero: the first frame.
  hal::Duration preamble_window{};
  /// A frame that much stronger takes the receiver over while the held one is still in its preamble
  /// or PLCP header. None: the held frame stays.
  std::optional<hal::Decibels> capture_margin;

  // MAC.
  hal::Duration slot = 20us;
  hal::Duration sifs = 10us;
  std::uint32_t cw_min = 7;             ///< One less than a power of two.
  std::uint32_t cw_max = 255;           ///< >= cw_min.
  std::uint32_t cw_broadcast = 31;      ///< mf.
  std::uint32_t rts_threshold = 0;      ///< Bytes of the MPDU; larger ones use RTS/CTS.
  std::uint32_t short_retry_limit = 7;  ///< Transmissions in all, >= 1. mf: the only counter.
  std::uint32_t long_retry_limit = 4;   ///< b: of data frames after RTS/CTS.
  std::uint32_t queue_limit = 14;       ///< Frames, >= 1.

  // disk and ideal.
  hal::Metres range{std::numeric_limits<double>::infinity()};  ///< > 0; may be infinite.
};

/// mf, the paper's NIC (the Mobility Framework's sample configuration): as above.
/// b: 802.11b with a long preamble, figures of ns-3.37's helper: 40 mW, 2.412 GHz, -82 dBm.
/// disk: 250.16 m, the range of mf, and 11 Mb/s. ideal: 250.16 m.
RadioConfig profile_defaults(Profile profile);

/// Whether stations contend for a medium: mobility_framework and ieee80211b.
bool has_mac(const RadioConfig& config);

}  // namespace sim::radio
