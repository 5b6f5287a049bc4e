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

/// Length of frames on the air.
enum class Lengths : std::uint8_t {
  kBytes,  ///< Their encoded length.
  kFixed,  ///< `header_bits` and `payload_bits`, whatever the frame carries.
};
/// Rounding of the duration of a frame.
enum class Rounding : std::uint8_t {
  kExact,        ///< To the nearest nanosecond per frame.
  kMicrosecond,  ///< Payload up to whole microseconds (IEEE Std 802.11-2016, 16.3.4: TXTIME).
};
/// Law of packet errors over SINR: of the Mobility Framework, or of each PHY mode.
enum class ErrorModel : std::uint8_t { kMobilityFramework, kDsss };
/// DSSS preamble.
enum class Preamble : std::uint8_t { kLong, kShort };
/// Which bits of an OFDM frame must arrive.
enum class BitsAtRisk : std::uint8_t {
  kMpdu,  ///< Those of the MPDU, FCS included.
  /// As many as fit between header and end, pad and signal extension included: ns-3.
  kPayloadTime,
};
/// Start of the EIFS after an erroneous frame.
enum class EifsStart : std::uint8_t {
  kMediumIdle,  ///< When the medium becomes idle (IEEE Std 802.11-2016, 10.3.2.3.7).
  kFrameEnd,    ///< At the end of that frame, even if others are on the air: ns-3.
};
/// Effect of a frame with an erroneous PHY header.
enum class HeaderError : std::uint8_t {
  kEifs,  ///< As of any erroneous frame.
  /// No EIFS. If another frame had begun during its preamble, carrier sense ignores both from then
  /// on: ns-3.
  kForgotten,
};
/// Protection of OFDM frames in a cell with 802.11b stations (10.26.2).
enum class ProtectionKind : std::uint8_t { kNone, kCtsToSelf, kRtsCts, kAuto };

/// Propagation from antenna to antenna.
struct PropagationConfig {
  hal::Metres wavelength{0.125};                        ///< > 0; on PhyConfig::channel.
  double path_loss_exponent = 2;                        ///< Of PowerLawConfig; reference 1 m, >= 1.
  std::vector<PathLossConfig> chain{PowerLawConfig{}};  ///< Exactly one law of distance.
  hal::Metres antenna_height{0.1};   ///< Above the body's origin; default of stations.
  hal::Decibels antenna_gain{0};     ///< Isotropic; default of stations.
  bool propagation_delay = false;    ///< Distance over 299792458 m/s; else 0.
  bool obstacles = false;            ///< Walls attenuate, and bodies if they have a loss.
  ObstacleLoss body_loss{};          ///< Of the bodies of robots and motes, with `obstacles`.
  hal::Dbm interference_floor{-85};  ///< Weaker signals are ignored. <= sensitivity.
};

/// Which frames a receiver senses and receives.
struct ReceiverConfig {
  hal::Dbm sensitivity{-85};       ///< Weaker frames cannot be received.
  hal::Dbm noise_floor{-110};      ///< Thermal noise and noise figure in the bandwidth.
  hal::Dbm cca_threshold{-85};     ///< Carrier sense: power of one frame.
  hal::Dbm energy_detection{-85};  ///< Carrier sense: summed power of all frames.
  /// Packet errors over SINR.
  ErrorModel error_model = ErrorModel::kMobilityFramework;
  /// Lowest usable SINR. kMobilityFramework: over the whole frame, below or equal is a collision.
  /// kDsss: of the preamble, below it the receiver does not synchronise.
  hal::Decibels min_sinr{4};
  /// The receiver synchronises with the strongest of the frames that start within this time after
  /// the first one. Zero: with the first frame.
  hal::Duration preamble_window{};
  /// A frame stronger by this margin captures the receiver within capture_window after it
  /// synchronised with another. None: no capture.
  std::optional<hal::Decibels> capture_margin;
  /// After the receiver synchronised.
  hal::Duration capture_window = 16us;
  HeaderError header_error = HeaderError::kEifs;
  LossConfig loss{};
};

/// DSSS and HR/DSSS, with ieee80211g also OFDM: rates_of().
struct PhyConfig {
  /// 1 .. 14. Stations on different channels do not hear or disturb each other; adjacent-channel
  /// leakage is not modelled.
  std::uint32_t channel = 1;
  hal::BitsPerSecond data_rate{11e6};       ///< Of unicast data; with rate control the highest.
  hal::BitsPerSecond control_rate{11e6};    ///< RTS; mobility_framework: also CTS and ACK.
  hal::BitsPerSecond broadcast_rate{11e6};  ///< Of group and management frames.
  Preamble preamble = Preamble::kLong;      ///< Of DSSS; frames at 1 Mb/s always have the long one.
  Rounding rounding = Rounding::kExact;
};

/// Length of frames on the air.
struct LengthsConfig {
  Lengths lengths = Lengths::kBytes;
  std::uint32_t header_bits = 272;  ///< kFixed: MAC header and FCS of a data frame.
  std::uint32_t payload_bits = 0;   ///< kFixed: a network packet.
};

/// Medium access.
struct ContentionConfig {
  hal::Duration slot = 20us;            ///< Slot time.
  hal::Duration sifs = 10us;            ///< Short interframe space; DIFS is SIFS and two slots.
  std::uint32_t cw_min = 7;             ///< One less than a power of two.
  std::uint32_t cw_max = 255;           ///< >= cw_min.
  std::uint32_t rts_threshold = 0;      ///< Bytes of the MPDU; larger frames use RTS/CTS.
  std::uint32_t short_retry_limit = 7;  ///< Transmissions in all, >= 1.
  std::uint32_t queue_limit = 14;       ///< Frames, >= 1.
};

/// The common part of the profiles in which stations contend for one medium, with the values of
/// mobility_framework. `kProfile` of a profile is its name in files, `kRates` the standard whose
/// rates it supports.
struct WavesConfig {
  hal::Milliwatts tx_power{2};  ///< > 0; default of stations.
  PropagationConfig propagation;
  ReceiverConfig receiver;
  PhyConfig phy;
  LengthsConfig lengths{.lengths = Lengths::kFixed};
  ContentionConfig contention;
};

/// The paper's radio: replica of the Mobility Framework 1.0a5 NIC, with the values of its sample
/// configuration. Its only retry limit is the short one.
struct MobilityFrameworkConfig : WavesConfig {
  static constexpr std::string_view kProfile = "mobility_framework";
  static constexpr Standard kRates = Standard::kIeee80211b;
  std::uint32_t cw_broadcast = 31;
};

/// The distributed coordination function of IEEE Std 802.11-2016, clause 10.
struct DcfConfig : WavesConfig {
  /// CTS and ACK use the highest of these rates that is not above the rate of the frame that they
  /// answer, in its modulation class; if there is none, the highest mandatory rate (10.7.6.5). Not
  /// empty.
  std::vector<hal::BitsPerSecond> basic_rates{hal::BitsPerSecond{1e6}};
  std::uint32_t long_retry_limit = 4;  ///< Of data frames after RTS/CTS.
  /// aCCATime plus aRxTxTurnaroundTime: a station whose backoff ends at a slot boundary does not
  /// detect frames that begin to arrive within this time before it (10.3.7). < slot.
  hal::Duration cca_time = 15us;
  EifsStart eifs_start = EifsStart::kMediumIdle;
  BssConfig bss;
  /// > 0, from the request: an older frame is given up instead of being sent (again). None: no
  /// limit.
  std::optional<hal::Duration> msdu_lifetime{};
  RateControlConfig rate_control{};
  /// Of OFDM frames. kAuto: kCtsToSelf in a mixed cell, else kNone.
  ProtectionKind protection = ProtectionKind::kAuto;
  hal::BitsPerSecond protection_rate{1e6};  ///< DSSS; of the protecting frames.

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

/// Delivers instantly and without loss within a range.
struct IdealConfig {
  static constexpr std::string_view kProfile = "ideal";
  hal::Metres range = kMobilityFrameworkRange;  ///< > 0; may be infinite.
  LengthsConfig lengths;
};

/// A range and a bit rate, without medium access.
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

/// A profile of a program that links the simulator, or of a test, with its own MAC (mac_parts.h).
/// Files cannot name it; records and messages do.
struct ForeignProfileConfig : WavesConfig {
  static constexpr Standard kRates = Standard::kIeee80211b;
  std::string_view profile;  ///< Its name; outlives the config, as a literal does.
  std::unique_ptr<MacBase> (*make_mac)(const MacParts& parts) = nullptr;  ///< Never null.
};

/// A radio profile with the value of each of its keys. Files can name all alternatives but the last
/// and set any key of the profile.
using RadioConfig = std::variant<MobilityFrameworkConfig, Ieee80211bConfig, Ieee80211gConfig,
                                 DiskConfig, IdealConfig, ForeignProfileConfig>;

/// The profiles that files can name, for programs without a file.
enum class Profile : std::uint8_t { kMobilityFramework, kIeee80211b, kIeee80211g, kDisk, kIdeal };
RadioConfig profile_defaults(Profile profile);

/// The profile's name, as in files.
std::string_view profile_name(const RadioConfig& config);

/// The common part of profiles with a medium; null for disk and ideal.
const WavesConfig* waves_of(const RadioConfig& config);
WavesConfig* waves_of(RadioConfig& config);

/// Null if the profile has no DCF.
const DcfConfig* dcf_of(const RadioConfig& config);
DcfConfig* dcf_of(RadioConfig& config);

/// The standard whose rates stations support; nullopt for disk and ideal.
std::optional<Standard> rates_of(const RadioConfig& config);
/// The rates of a standard, Mb/s, as text for messages; and whether this is one of them.
std::string_view rates_of(Standard standard);
bool is_rate(Standard standard, hal::BitsPerSecond rate);
bool is_dsss_rate(hal::BitsPerSecond rate);

const LengthsConfig& lengths_of(const RadioConfig& config);

}  // namespace sim::radio
