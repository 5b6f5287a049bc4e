#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/core/obstacle_loss.h"
#include "sim/radio/channel/antenna.h"
#include "sim/radio/channel/channel_number.h"
#include "sim/radio/channel/loss_config.h"
#include "sim/radio/channel/path_loss_config.h"

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
  hal::Metres antenna_height{0.1};  ///< Above the body's origin; default for stations.
  hal::Decibels antenna_gain{
      0};  ///< In all directions, or times that of `antenna`; default for stations.
  AntennaConfig antenna{};           ///< Default for stations.
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
  /// is_channel(), the primary one of wider channels; in 5 GHz only with ieee80211n and newer.
  /// Stations on different channels neither hear nor disturb each other; adjacent-channel leakage
  /// is not modelled, nor are channels that overlap.
  std::uint32_t channel = 1;
  /// Rate of unicast data; with rate control, the highest rate. Not of stations with MCSs.
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

}  // namespace sim::radio
