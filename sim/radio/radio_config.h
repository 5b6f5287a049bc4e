#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/core/obstacle_loss.h"
#include "sim/radio/path_loss_config.h"

namespace sim::radio {

using namespace std::chrono_literals;

enum class Lengths : std::uint8_t {
  kBytes,  ///< What the codec would put on the air.
  kFixed,  ///< `header_bits` and `payload_bits`, whatever the frame carries.
};
enum class Rounding : std::uint8_t {
  kExact,        ///< To the nearest nanosecond per frame.
  kMicrosecond,  ///< Payload up to whole microseconds (IEEE Std 802.11-2016, 16.3.4: TXTIME).
};
enum class ErrorModel : std::uint8_t { kMobilityFramework, kDsss };
enum class Preamble : std::uint8_t { kLong, kShort };

/// From antenna to antenna.
struct PropagationConfig {
  hal::Metres wavelength{0.125};                        ///< > 0.
  double path_loss_exponent = 2;                        ///< Of PowerLawConfig; reference 1 m, >= 1.
  std::vector<PathLossConfig> chain{PowerLawConfig{}};  ///< Exactly one law of distance.
  hal::Metres antenna_height{0.1};   ///< Above the body's origin; of a station without its own.
  bool propagation_delay = false;    ///< Distance over 299792458 m/s.
  bool obstacles = false;            ///< Walls attenuate, and bodies if they have a loss.
  ObstacleLoss body_loss{};          ///< Of the bodies of robots and motes, with `obstacles`.
  hal::Dbm interference_floor{-85};  ///< Weaker than this does not exist. <= sensitivity.
};

/// When a receiver notices, senses, and gets a frame.
struct ReceiverConfig {
  hal::Dbm sensitivity{-85};       ///< Weaker frames cannot be received.
  hal::Dbm noise_floor{-110};      ///< Thermal noise and noise figure in the bandwidth.
  hal::Dbm cca_threshold{-85};     ///< Carrier sense: a frame present.
  hal::Dbm energy_detection{-85};  ///< Carrier sense: sum of all frames.
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
};

/// DSSS and HR/DSSS. Rates: 1, 2, 5.5 or 11 Mb/s.
struct DsssConfig {
  hal::BitsPerSecond data_rate{11e6};
  hal::BitsPerSecond control_rate{11e6};  ///< RTS, CTS, ACK.
  hal::BitsPerSecond broadcast_rate{11e6};
  Preamble preamble = Preamble::kLong;  ///< kShort: not for frames at 1 Mb/s.
  Rounding rounding = Rounding::kExact;
};

struct LengthsConfig {
  Lengths lengths = Lengths::kBytes;
  std::uint32_t header_bits = 272;  ///< kFixed: MAC header and FCS of a data frame.
  std::uint32_t payload_bits = 0;   ///< kFixed: a network packet.
};

struct ContentionConfig {
  hal::Duration slot = 20us;
  hal::Duration sifs = 10us;
  std::uint32_t cw_min = 7;             ///< One less than a power of two.
  std::uint32_t cw_max = 255;           ///< >= cw_min.
  std::uint32_t rts_threshold = 0;      ///< Bytes of the MPDU; larger ones use RTS/CTS.
  std::uint32_t short_retry_limit = 7;  ///< Transmissions in all, >= 1.
  std::uint32_t queue_limit = 14;       ///< Frames, >= 1.
};

/// What the profiles have in common in which stations contend for one medium. The values: of
/// mobility_framework.
struct WavesConfig {
  hal::Milliwatts tx_power{2};  ///< > 0; of a station that has none of its own.
  PropagationConfig propagation;
  ReceiverConfig receiver;
  DsssConfig phy;
  LengthsConfig lengths{.lengths = Lengths::kFixed};
  ContentionConfig contention;
};

/// The paper's: replica of the Mobility Framework 1.0a5 NIC, values of its sample configuration.
/// The short retry limit is its only one.
struct MobilityFrameworkConfig : WavesConfig {
  std::uint32_t cw_broadcast = 31;
};

/// IEEE Std 802.11-2016, clauses 10 and 16, with a long preamble and the figures of ns-3.37's
/// helper: 40 mW, 2.412 GHz, -82 dBm.
struct Ieee80211bConfig : WavesConfig {
  Ieee80211bConfig();
  std::uint32_t long_retry_limit = 4;  ///< Of data frames after RTS/CTS.
};

/// Range of mobility_framework: 0.125 m / (4 pi) * sqrt(2 mW / -85 dBm), rounded up.
inline constexpr hal::Metres kMobilityFrameworkRange{250.16};

/// Instant and lossless within a range.
struct IdealConfig {
  hal::Metres range = kMobilityFrameworkRange;  ///< > 0; may be infinite.
  LengthsConfig lengths;
};

/// A range and a bit rate, no MAC.
struct DiskConfig {
  hal::Milliwatts tx_power{2};                  ///< For the energy only.
  hal::Metres range = kMobilityFrameworkRange;  ///< > 0; may be infinite.
  hal::BitsPerSecond data_rate{11e6};
  LengthsConfig lengths;
  std::uint32_t queue_limit = 14;  ///< Frames, >= 1.
};

/// One radio profile with every key resolved; without more said, with its own values. A radio file
/// may set any key of its profile.
using RadioConfig =
    std::variant<MobilityFrameworkConfig, Ieee80211bConfig, DiskConfig, IdealConfig>;

/// In the order of RadioConfig.
enum class Profile : std::uint8_t { kMobilityFramework, kIeee80211b, kDisk, kIdeal };

Profile profile_of(const RadioConfig& config);
RadioConfig profile_defaults(Profile profile);

/// What profiles with a medium have in common; null: of disk and ideal.
const WavesConfig* waves_of(const RadioConfig& config);
WavesConfig* waves_of(RadioConfig& config);

const LengthsConfig& lengths_of(const RadioConfig& config);

/// @throws std::invalid_argument  a value that its comment excludes.
void check(const RadioConfig& config);

}  // namespace sim::radio
