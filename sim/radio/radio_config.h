#pragma once

#include <array>
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
#include "sim/radio/channel/channel_number.h"
#include "sim/radio/channel/loss_config.h"
#include "sim/radio/channel/path_loss_config.h"
#include "sim/radio/infrastructure/bss_config.h"
#include "sim/radio/mac/aggregation_config.h"
#include "sim/radio/mac/edca_config.h"
#include "sim/radio/rate/rate_control_config.h"
#include "sim/radio/station_config.h"

namespace sim::radio {

using namespace std::chrono_literals;

/// Length of frames on the air.
enum class Lengths : std::uint8_t {
  kBytes,  ///< Length of the encoded frame.
  kFixed,  ///< `header_bits` and `payload_bits`, whatever the frame carries.
};
/// Rounding of the duration of a frame.
enum class Rounding : std::uint8_t {
  kExact,  ///< To the nearest nanosecond per frame.
  /// Payload rounded up to whole microseconds (IEEE Std 802.11-2016, 16.3.4: TXTIME).
  kMicrosecond,
};
/// Packet error model: that of the Mobility Framework, or that of each PHY mode.
enum class ErrorModel : std::uint8_t { kMobilityFramework, kDsss };
/// DSSS preamble.
enum class Preamble : std::uint8_t { kLong, kShort };
/// Which bits of an OFDM frame must arrive.
enum class BitsAtRisk : std::uint8_t {
  kMpdu,  ///< The bits of the MPDU with FCS.
  /// As many as fit between header and end, including pad and signal extension, as in ns-3.
  kPayloadTime,
};
/// How long HT, VHT and HE frames last.
enum class PpduTimes : std::uint8_t {
  kStandard,  ///< IEEE Std 802.11-2020, 19.4.3 and 21.4.3; IEEE Std 802.11ax-2021, 27.4.3.
  /// As in ns-3.37: with the short guard interval the data field may end between multiples of 4 us,
  /// VHT frames have no VHT-SIG-B (4 us), and HE-LTFs last 8 us each with any guard interval.
  kNs3,
};
/// Start of the EIFS after an erroneous frame.
enum class EifsStart : std::uint8_t {
  kMediumIdle,  ///< When the medium becomes idle (IEEE Std 802.11-2016, 10.3.2.3.7).
  kFrameEnd,    ///< At the end of that frame, even if others are on the air, as in ns-3.
};
/// Effect of a frame with an erroneous PHY header.
enum class HeaderError : std::uint8_t {
  kEifs,  ///< The same as for any erroneous frame.
  /// No EIFS. If another frame had begun during its preamble, carrier sense ignores both from then
  /// on, as in ns-3.
  kForgotten,
};
/// Protection of OFDM frames in a cell with 802.11b stations (10.26.2).
enum class ProtectionKind : std::uint8_t { kNone, kCtsToSelf, kRtsCts, kAuto };

/// Propagation from one antenna to another.
struct PropagationConfig {
  hal::Metres wavelength{0.125};  ///< > 0; for PhyConfig::channel.
  double path_loss_exponent = 2;  ///< Exponent of PowerLawConfig, >= 1; reference distance 1 m.
  /// Exactly one of them is a law of distance.
  std::vector<PathLossConfig> chain{PowerLawConfig{}};
  hal::Metres antenna_height{0.1};   ///< Above the body's origin; default for stations.
  hal::Decibels antenna_gain{0};     ///< Isotropic; default for stations.
  bool propagation_delay = false;    ///< Delay of distance over 299792458 m/s, else 0.
  bool obstacles = false;            ///< Walls attenuate, and so do bodies that have a loss.
  ObstacleLoss body_loss{};          ///< Loss through a robot or mote, with `obstacles`.
  hal::Dbm interference_floor{-85};  ///< Weaker signals are ignored. <= sensitivity.
};

/// Which frames a receiver senses and receives.
struct ReceiverConfig {
  hal::Dbm sensitivity{-85};       ///< Weaker frames cannot be received.
  hal::Dbm noise_floor{-110};      ///< Thermal noise and noise figure in the bandwidth.
  hal::Dbm cca_threshold{-85};     ///< Carrier sense by the power of a single frame.
  hal::Dbm energy_detection{-85};  ///< Carrier sense by the total power of all frames.
  /// Packet error model.
  ErrorModel error_model = ErrorModel::kMobilityFramework;
  /// Lowest usable SINR. kMobilityFramework: a frame whose lowest SINR is not above it counts as a
  /// collision. kDsss: the receiver does not synchronise to a preamble below it.
  hal::Decibels min_sinr{4};
  /// The receiver synchronises to the strongest of the frames that start within this time after the
  /// first one. Zero: to the first frame.
  hal::Duration preamble_window{};
  /// A frame stronger by this margin captures the receiver within capture_window after it
  /// synchronised to another. nullopt: no capture.
  std::optional<hal::Decibels> capture_margin;
  /// Starts when the receiver has synchronised.
  hal::Duration capture_window = 16us;
  HeaderError header_error = HeaderError::kEifs;
  LossConfig loss{};
};

/// DSSS and HR/DSSS; with ieee80211g also OFDM. rates_of() gives the rates.
struct PhyConfig {
  /// 1 .. 14. Stations on different channels neither hear nor disturb each other; adjacent-channel
  /// leakage is not modelled.
  std::uint32_t channel = 1;
  /// Rate of unicast data; with rate control, the highest rate.
  hal::BitsPerSecond data_rate{11e6};
  hal::BitsPerSecond control_rate{11e6};  ///< Rate of RTS; mobility_framework: also of CTS and ACK.
  hal::BitsPerSecond broadcast_rate{11e6};  ///< Rate of group and management frames.
  Preamble preamble = Preamble::kLong;  ///< For DSSS; frames at 1 Mb/s always have the long one.
  Rounding rounding = Rounding::kExact;
};

/// Length of frames on the air.
struct LengthsConfig {
  Lengths lengths = Lengths::kBytes;
  std::uint32_t header_bits = 272;  ///< kFixed: MAC header and FCS of a data frame.
  std::uint32_t payload_bits = 0;   ///< kFixed: network packet, whatever its size.
};

/// Medium access.
struct ContentionConfig {
  hal::Duration slot = 20us;            ///< Slot time.
  hal::Duration sifs = 10us;            ///< Short interframe space; DIFS = SIFS + 2 slots.
  std::uint32_t cw_min = 7;             ///< One less than a power of two.
  std::uint32_t cw_max = 255;           ///< >= cw_min.
  std::uint32_t rts_threshold = 0;      ///< MPDU size in bytes; larger frames use RTS/CTS.
  std::uint32_t short_retry_limit = 7;  ///< Transmissions in all, >= 1.
  std::uint32_t queue_limit = 14;       ///< In frames, >= 1.
};

/// The common part of the profiles in which stations contend for one medium; the defaults are those
/// of mobility_framework. In each profile, `kProfile` is its name in files and `kRates` the
/// standard whose rates it supports.
struct WavesConfig {
  hal::Milliwatts tx_power{2};  ///< > 0; default for stations.
  PropagationConfig propagation;
  ReceiverConfig receiver;
  PhyConfig phy;
  LengthsConfig lengths{.lengths = Lengths::kFixed};
  ContentionConfig contention;
};

/// The paper's radio: a replica of the Mobility Framework 1.0a5 NIC, with the values of its sample
/// configuration. It has no long retry limit.
struct MobilityFrameworkConfig : WavesConfig {
  static constexpr std::string_view kProfile = "mobility_framework";
  static constexpr Standard kRates = Standard::kIeee80211b;
  std::uint32_t cw_broadcast = 31;
};

/// The distributed coordination function of IEEE Std 802.11-2016, clause 10.
struct DcfConfig : WavesConfig {
  /// CTS and ACK use the highest of these rates that does not exceed the rate of the frame that
  /// they answer, in its modulation class; if there is none, the highest mandatory rate (10.7.6.5).
  /// Not empty.
  std::vector<hal::BitsPerSecond> basic_rates{hal::BitsPerSecond{1e6}};
  std::uint32_t long_retry_limit = 4;  ///< Transmissions of data frames after RTS/CTS.
  /// aCCATime plus aRxTxTurnaroundTime: a station whose backoff ends at a slot boundary does not
  /// detect frames that begin to arrive within this time before it (10.3.7). < slot.
  hal::Duration cca_time = 15us;
  EifsStart eifs_start = EifsStart::kMediumIdle;
  BssConfig bss;
  /// Time from the request after which a frame is given up instead of being sent (again), > 0.
  /// nullopt: no limit.
  std::optional<hal::Duration> msdu_lifetime{};
  RateControlConfig rate_control{};
  /// Protection of OFDM frames. kAuto: kCtsToSelf in a mixed cell, else kNone.
  ProtectionKind protection = ProtectionKind::kAuto;
  hal::BitsPerSecond protection_rate{1e6};  ///< Rate of the protecting frames, a DSSS rate.
  /// QoS station: data frames have the QoS header, and `edca` replaces the windows of `contention`
  /// (10.2.3.2).
  bool qos = false;
  EdcaConfig edca = edca_defaults(31, 1023, true);  ///< With `qos`.
  AggregationConfig aggregation{};                  ///< With `qos`.

 protected:
  DcfConfig();
};

/// IEEE Std 802.11-2016, clauses 10 and 16, with a long preamble and the values of ns-3.37's
/// helper: 40 mW, 2.412 GHz, -82 dBm. Energy detection: 16.3.8.5, up to 50 mW.
struct Ieee80211bConfig : DcfConfig {
  static constexpr std::string_view kProfile = "ieee80211b";
  static constexpr Standard kRates = Standard::kIeee80211b;
  Ieee80211bConfig();
};

/// The same with clause 18: ERP-OFDM, and DSSS for broadcasts at 1 to 11 Mb/s. Data at 54 Mb/s, RTS
/// at 24 Mb/s, broadcasts at 6 Mb/s; the long slot, as in an independent network (18.4.4).
struct Ieee80211gConfig : DcfConfig {
  static constexpr std::string_view kProfile = "ieee80211g";
  static constexpr Standard kRates = Standard::kIeee80211g;
  Ieee80211gConfig();
  BitsAtRisk bits_at_risk = BitsAtRisk::kMpdu;
};

/// Range of mobility_framework: 0.125 m / (4 pi) * sqrt(2 mW / -85 dBm), rounded up.
inline constexpr hal::Metres kMobilityFrameworkRange{250.16};

/// Delivers frames instantly and without loss within a range.
struct IdealConfig {
  static constexpr std::string_view kProfile = "ideal";
  hal::Metres range = kMobilityFrameworkRange;  ///< > 0; may be infinite.
  LengthsConfig lengths;
};

/// Delivers frames within a range at a bit rate, without contention.
struct DiskConfig {
  static constexpr std::string_view kProfile = "disk";
  hal::Milliwatts tx_power{2};                  ///< Affects only the energy.
  hal::Metres range = kMobilityFrameworkRange;  ///< > 0; may be infinite.
  hal::BitsPerSecond data_rate{11e6};
  LengthsConfig lengths;
  std::uint32_t queue_limit = 14;  ///< In frames, >= 1.
};

class MacBase;
struct MacParts;

/// A profile with its own MAC (mac_parts.h), of a test or of a program that links the simulator.
/// Scenario files cannot select it; records and messages name it.
struct ForeignProfileConfig : WavesConfig {
  static constexpr Standard kRates = Standard::kIeee80211b;
  std::string_view profile;  ///< Name of the profile; must outlive the config, as a literal does.
  std::unique_ptr<MacBase> (*make_mac)(const MacParts& parts) = nullptr;  ///< Never null.
};

/// A radio profile with the values of all its keys. Scenario files can select every alternative but
/// the last and set any key of the profile.
using RadioConfig = std::variant<MobilityFrameworkConfig, Ieee80211bConfig, Ieee80211gConfig,
                                 DiskConfig, IdealConfig, ForeignProfileConfig>;

/// The profiles that scenario files can select, for programs without a file.
enum class Profile : std::uint8_t { kMobilityFramework, kIeee80211b, kIeee80211g, kDisk, kIdeal };
RadioConfig profile_defaults(Profile profile);

/// Name of the profile as in scenario files.
std::string_view profile_name(const RadioConfig& config);

/// The common part of a profile with a medium; null for disk and ideal.
const WavesConfig* waves_of(const RadioConfig& config);
WavesConfig* waves_of(RadioConfig& config);

/// The DCF's settings; null if the profile has no DCF.
const DcfConfig* dcf_of(const RadioConfig& config);
DcfConfig* dcf_of(RadioConfig& config);

/// The rates of DSSS and HR/DSSS, and those of OFDM in 20 MHz, b/s (IEEE Std 802.11-2016, 16.1.2
/// and 17.1.1).
inline constexpr std::array kDsssRates{1e6, 2e6, 5.5e6, 11e6};
inline constexpr std::array kOfdmRates{6e6, 9e6, 12e6, 18e6, 24e6, 36e6, 48e6, 54e6};

/// The standard whose rates stations support; nullopt for disk and ideal.
std::optional<Standard> rates_of(const RadioConfig& config);
/// The rates of a standard as text for messages [Mb/s]; whether a rate is one of them.
std::string_view rates_of(Standard standard);
bool is_rate(Standard standard, hal::BitsPerSecond rate);
bool is_dsss_rate(hal::BitsPerSecond rate);

const LengthsConfig& lengths_of(const RadioConfig& config);

}  // namespace sim::radio
