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
/// radio file may set any key that the profile uses.
struct RadioConfig {
  Profile profile = Profile::kIeee80211b;

  // Propagation and noise.
  hal::Milliwatts tx_power{2};
  hal::Metres wavelength{0.125};
  double path_loss_exponent = 2;           ///< Friis power law, reference 1 m.
  bool propagation_delay = false;
  bool obstacles = false;                  ///< Walls attenuate.
  hal::Dbm sensitivity{-85};               ///< Weaker frames cannot be received …
  hal::Dbm interference_floor{-85};        ///< … and weaker than this do not exist.
  hal::Dbm noise_floor{-110};
  hal::Dbm cca_threshold{-85};             ///< Carrier sense: a frame present.
  hal::Dbm energy_detection{-85};          ///< Carrier sense: any energy.

  // PHY.
  hal::BitsPerSecond data_rate{11e6};
  hal::BitsPerSecond control_rate{11e6};   ///< RTS, CTS, ACK.
  hal::BitsPerSecond broadcast_rate{11e6};
  Preamble preamble = Preamble::kLong;
  Rounding rounding = Rounding::kExact;
  Lengths lengths = Lengths::kFixed;
  std::uint32_t fixed_header_bits = 272;
  std::uint32_t fixed_payload_bits = 0;
  ErrorModel error_model = ErrorModel::kMobilityFramework;
  hal::Decibels min_sinr{4};               ///< Below: collision.
  std::optional<hal::Decibels> capture_margin;  ///< None: the first frame holds the receiver.

  // MAC.
  hal::Duration slot = 20us;
  hal::Duration sifs = 10us;
  std::uint32_t cw_min = 7;
  std::uint32_t cw_max = 255;
  std::uint32_t cw_broadcast = 31;         ///< mobility_framework only.
  std::uint32_t rts_threshold = 0;         ///< Bytes of the MPDU; larger ones use RTS/CTS.
  std::uint32_t short_retry_limit = 7;
  std::uint32_t long_retry_limit = 4;
  std::uint32_t queue_limit = 14;          ///< Frames.

  // disk and ideal.
  hal::Metres range{std::numeric_limits<double>::infinity()};
};

RadioConfig profile_defaults(Profile profile);

}  // namespace sim::radio
