#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "hal/types/quantity.h"
#include "hal/types/time.h"
#include "sim/radio/infrastructure/bss_config.h"
#include "sim/radio/mac/aggregation_config.h"
#include "sim/radio/mac/edca_config.h"
#include "sim/radio/mac/queues_config.h"
#include "sim/radio/phy/error_table.h"
#include "sim/radio/rate/rate_control_config.h"
#include "sim/radio/station_config.h"
#include "sim/radio/waves_config.h"

namespace sim::radio {

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
  /// With kAuto: frames wider than 20 MHz are protected where some HT stations have only 20 MHz.
  bool wide_protection = false;
  /// QoS station: data frames have the QoS header, and `edca` replaces the windows of `contention`
  /// (10.2.3.2).
  bool qos = false;
  /// Rate of beacons; nullopt: that of broadcasts.
  std::optional<hal::BitsPerSecond> beacon_rate{};
  EdcaConfig edca = edca_defaults(31, 1023, true);  ///< With `qos`.
  AggregationConfig aggregation{};                  ///< With `qos`.
  QueuesConfig queues{};

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
  ErrorTable error_table{};  ///< Replaces the formula for the modes that it has.
};

/// Mode of unicast data in the profiles with MCSs; with rate control, the highest MCS and most
/// streams. A receiver that supports less gets nearest() and the same or the next lower MCS.
struct McsConfig {
  std::uint8_t mcs = 7;         ///< HT: 0 .. 7, for each stream; VHT: 0 .. 9; HE: 0 .. 11.
  std::uint8_t streams = 1;     ///< 1 .. 4; also antennas, for sending and receiving.
  std::uint16_t width = 20;     ///< 20, 40 or 80 MHz, as has_width().
  hal::Duration guard = 800ns;  ///< HT and VHT: 400 or 800 ns; HE: 800, 1600 or 3200 ns.
  PpduTimes times = PpduTimes::kStandard;
};

/// The common part of the profiles with MCSs, in 2.4 or 5 GHz: QoS stations. Data in the mode of
/// `mcs`, RTS at 24 Mb/s, group frames at 6 Mb/s, and the short slot, which HT stations announce.
struct HtConfig : Ieee80211gConfig {
  ModulationClass modulation = ModulationClass::kHt;  ///< The newest.
  McsConfig mcs;

 protected:
  /// @param channel  determines the band. @param max_ampdu  bytes
  HtConfig(ModulationClass newest, const McsConfig& the_mcs, std::uint32_t channel,
           std::uint32_t max_ampdu);
};

/// IEEE Std 802.11-2020, clauses 10 and 19: one stream in 20 MHz of 2.4 GHz, MCS 7, long guard
/// interval, as in ns-3.37.
struct Ieee80211nConfig : HtConfig {
  static constexpr std::string_view kProfile = "ieee80211n";
  static constexpr Standard kRates = Standard::kIeee80211n;
  Ieee80211nConfig() : HtConfig(ModulationClass::kHt, {}, 1, 65'535) {}
};

/// Clause 21: one stream in 80 MHz at channel 36, MCS 9, long guard interval, as in ns-3.37.
struct Ieee80211acConfig : HtConfig {
  static constexpr std::string_view kProfile = "ieee80211ac";
  static constexpr Standard kRates = Standard::kIeee80211ac;
  Ieee80211acConfig() : HtConfig(ModulationClass::kVht, {.mcs = 9, .width = 80}, 36, 1'048'575) {}
};

/// IEEE Std 802.11ax-2021, clause 27, single user: one stream in 80 MHz at channel 36, MCS 11, the
/// shortest guard interval, which Linux's rate control prefers.
struct Ieee80211axConfig : HtConfig {
  static constexpr std::string_view kProfile = "ieee80211ax";
  static constexpr Standard kRates = Standard::kIeee80211ax;
  Ieee80211axConfig();
};

/// Sets a channel number and what depends on the band: the wavelength, and SIFS (IEEE Std
/// 802.11-2020, tables 18-5 and 17-21).
void set_channel(HtConfig& config, std::uint32_t channel);

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
                                 Ieee80211nConfig, Ieee80211acConfig, Ieee80211axConfig, DiskConfig,
                                 IdealConfig, ForeignProfileConfig>;

/// The profiles that scenario files can select, for programs without a file.
enum class Profile : std::uint8_t {
  kMobilityFramework,
  kIeee80211b,
  kIeee80211g,
  kIeee80211n,
  kIeee80211ac,
  kIeee80211ax,
  kDisk,
  kIdeal
};
RadioConfig profile_defaults(Profile profile);

/// Name of the profile as in scenario files.
std::string_view profile_name(const RadioConfig& config);

/// The common part of a profile with a medium; null for disk and ideal.
const WavesConfig* waves_of(const RadioConfig& config);
WavesConfig* waves_of(RadioConfig& config);

/// The DCF's settings; null if the profile has no DCF.
const DcfConfig* dcf_of(const RadioConfig& config);
DcfConfig* dcf_of(RadioConfig& config);

/// The settings of a profile with OFDM, and of one with MCSs; null if the profile has none.
const Ieee80211gConfig* ofdm_of(const RadioConfig& config);
const HtConfig* ht_of(const RadioConfig& config);
HtConfig* ht_of(RadioConfig& config);

/// The standard whose rates stations support; nullopt for disk and ideal.
std::optional<Standard> rates_of(const RadioConfig& config);

const LengthsConfig& lengths_of(const RadioConfig& config);

}  // namespace sim::radio
