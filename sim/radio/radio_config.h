#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/core/obstacle_loss.h"
#include "sim/radio/bss_config.h"
#include "sim/radio/channel_number.h"
#include "sim/radio/loss_config.h"
#include "sim/radio/path_loss_config.h"
#include "sim/radio/rate_control_config.h"
#include "sim/radio/station_config.h"

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
/// Which bits of an OFDM frame must arrive.
enum class BitsAtRisk : std::uint8_t {
  kMpdu,         ///< Those of the MPDU, FCS included.
  kPayloadTime,  ///< As many as fit between header and end, pad and signal extension included:
                 ///< ns-3.
};
/// When the EIFS after a frame that came in wrong begins.
enum class EifsStart : std::uint8_t {
  kMediumIdle,  ///< As the medium becomes idle (IEEE Std 802.11-2016, 10.3.2.3.7).
  kFrameEnd,    ///< At that frame's end, whatever else is still on the air: ns-3.
};
/// What follows a frame whose PHY header was wrong.
enum class HeaderError : std::uint8_t {
  kEifs,       ///< As after any frame that came in wrong.
  kForgotten,  ///< No EIFS; and if another frame had begun in its preamble, none of the two is
               ///< sensed any more: ns-3.
};
enum class ProtectionKind : std::uint8_t { kNone, kCtsToSelf, kRtsCts, kAuto };

/// From antenna to antenna.
struct PropagationConfig {
  hal::Metres wavelength{0.125};                        ///< > 0; on PhyConfig::channel.
  double path_loss_exponent = 2;                        ///< Of PowerLawConfig; reference 1 m, >= 1.
  std::vector<PathLossConfig> chain{PowerLawConfig{}};  ///< Exactly one law of distance.
  hal::Metres antenna_height{0.1};   ///< Above the body's origin; of a station without its own.
  hal::Decibels antenna_gain{0};     ///< To all sides, of a station without its own.
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
  /// A frame that much stronger takes the receiver over as long as this after it has synchronised
  /// to the held one. None: the held frame stays.
  std::optional<hal::Decibels> capture_margin;
  hal::Duration capture_window = 16us;
  HeaderError header_error = HeaderError::kEifs;
  LossConfig loss{};
};

/// DSSS and HR/DSSS, with ieee80211g also OFDM: rates_of().
struct PhyConfig {
  /// 1 .. 14. Stations on different ones do not know of each other; what leaks into a neighbouring
  /// channel is not modelled.
  std::uint32_t channel = 1;
  hal::BitsPerSecond data_rate{11e6};
  hal::BitsPerSecond control_rate{11e6};  ///< RTS; mobility_framework: also CTS and ACK.
  hal::BitsPerSecond broadcast_rate{11e6};
  Preamble preamble = Preamble::kLong;  ///< Of DSSS; frames at 1 Mb/s have the long one anyway.
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
/// mobility_framework. A profile says its name in files in `kProfile`; with waves, in `kRates`,
/// which standard's rates it knows.
struct WavesConfig {
  hal::Milliwatts tx_power{2};  ///< > 0; of a station that has none of its own.
  PropagationConfig propagation;
  ReceiverConfig receiver;
  PhyConfig phy;
  LengthsConfig lengths{.lengths = Lengths::kFixed};
  ContentionConfig contention;
};

/// The paper's: replica of the Mobility Framework 1.0a5 NIC, values of its sample configuration.
/// The short retry limit is its only one.
struct MobilityFrameworkConfig : WavesConfig {
  static constexpr std::string_view kProfile = "mobility_framework";
  static constexpr Standard kRates = Standard::kIeee80211b;
  std::uint32_t cw_broadcast = 31;
};

/// The distributed coordination function of IEEE Std 802.11-2016, clause 10.
struct DcfConfig : WavesConfig {
  /// CTS and ACK are sent at the highest of these that is not above the rate of the frame that they
  /// answer, and in its modulation class; without any, at the highest mandatory rate (10.7.6.5).
  /// Not empty.
  std::vector<hal::BitsPerSecond> basic_rates{hal::BitsPerSecond{1e6}};
  std::uint32_t long_retry_limit = 4;  ///< Of data frames after RTS/CTS.
  /// aCCATime and aRxTxTurnaroundTime: a station that is to send at a slot boundary does so
  /// whatever begins to arrive within this time before (10.3.7). < slot.
  hal::Duration cca_time = 15us;
  EifsStart eifs_start = EifsStart::kMediumIdle;
  BssConfig bss;
  /// Since it was queued; a frame that is older is given up instead of being sent (again). > 0.
  std::optional<hal::Duration> msdu_lifetime{};
  RateControlConfig rate_control{};
  /// Of frames in OFDM. kAuto: kCtsToSelf in a mixed cell, else kNone.
  ProtectionKind protection = ProtectionKind::kAuto;
  hal::BitsPerSecond protection_rate{1e6};  ///< DSSS; of what protects.

 protected:
  DcfConfig();
};

/// IEEE Std 802.11-2016, clauses 10 and 16, with a long preamble and the figures of ns-3.37's
/// helper: 40 mW, 2.412 GHz, -82 dBm. Energy detection: 16.3.8.5, up to 50 mW.
struct Ieee80211bConfig : DcfConfig {
  static constexpr std::string_view kProfile = "ieee80211b";
  static constexpr Standard kRates = Standard::kIeee80211b;
  Ieee80211bConfig();
};

/// The same, clauses 10, 16 and 18: ERP-OFDM, and DSSS for broadcasts at 1 to 11 Mb/s. 54 Mb/s, RTS
/// at 24 Mb/s, broadcasts at 6 Mb/s; the long slot, as in an independent network (18.4.4).
struct Ieee80211gConfig : DcfConfig {
  static constexpr std::string_view kProfile = "ieee80211g";
  static constexpr Standard kRates = Standard::kIeee80211g;
  Ieee80211gConfig();
  BitsAtRisk bits_at_risk = BitsAtRisk::kMpdu;
};

/// Range of mobility_framework: 0.125 m / (4 pi) * sqrt(2 mW / -85 dBm), rounded up.
inline constexpr hal::Metres kMobilityFrameworkRange{250.16};

/// Instant and lossless within a range.
struct IdealConfig {
  static constexpr std::string_view kProfile = "ideal";
  hal::Metres range = kMobilityFrameworkRange;  ///< > 0; may be infinite.
  LengthsConfig lengths;
};

/// A range and a bit rate, no MAC.
struct DiskConfig {
  static constexpr std::string_view kProfile = "disk";
  hal::Milliwatts tx_power{2};                  ///< For the energy only.
  hal::Metres range = kMobilityFrameworkRange;  ///< > 0; may be infinite.
  hal::BitsPerSecond data_rate{11e6};
  LengthsConfig lengths;
  std::uint32_t queue_limit = 14;  ///< Frames, >= 1.
};

class MacBase;
struct MacParts;

/// A profile from outside the simulator: of a program that links it, or of a test. It has waves,
/// and a MAC of its own (mac_parts.h). Files cannot name it; records and messages do.
struct ForeignProfileConfig : WavesConfig {
  static constexpr Standard kRates = Standard::kIeee80211b;
  std::string_view profile;  ///< Its name; outlives the config, as a literal does.
  std::unique_ptr<MacBase> (*make_mac)(const MacParts& parts) = nullptr;  ///< Never null.
};

/// One radio profile with every key resolved; without more said, with its own values. A radio file
/// may set any key of its profile, and name all but the last.
using RadioConfig = std::variant<MobilityFrameworkConfig, Ieee80211bConfig, Ieee80211gConfig,
                                 DiskConfig, IdealConfig, ForeignProfileConfig>;

/// Those that files can name, for programs that do without a file.
enum class Profile : std::uint8_t { kMobilityFramework, kIeee80211b, kIeee80211g, kDisk, kIdeal };
RadioConfig profile_defaults(Profile profile);

/// The profile's name, as in files.
std::string_view profile_name(const RadioConfig& config);

/// What profiles with a medium have in common; null: of disk and ideal.
const WavesConfig* waves_of(const RadioConfig& config);
WavesConfig* waves_of(RadioConfig& config);

/// Null: the profile has no DCF.
const DcfConfig* dcf_of(const RadioConfig& config);
DcfConfig* dcf_of(RadioConfig& config);

/// Whose rates stations know; none: the profile has no waves.
std::optional<Standard> rates_of(const RadioConfig& config);
/// The rates that a standard knows, Mb/s, for people; and whether this is one of them.
std::string_view rates_of(Standard standard);
bool is_rate(Standard standard, hal::BitsPerSecond rate);
bool is_dsss_rate(hal::BitsPerSecond rate);

const LengthsConfig& lengths_of(const RadioConfig& config);

/// @throws std::invalid_argument  a value that its comment excludes.
void check(const RadioConfig& config);
void check(const RadioConfig& config, const StationConfig& station);

}  // namespace sim::radio
