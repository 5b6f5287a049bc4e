#include "sim/scenario/radio_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "sim/scenario/fields.h"

namespace sim::scenario {
namespace {

using radio::Profile;
using radio::RadioConfig;

constexpr std::array kProfiles = {
    Option<Profile>{"mobility_framework", Profile::kMobilityFramework},
    Option<Profile>{"ieee80211b", Profile::kIeee80211b}, Option<Profile>{"disk", Profile::kDisk},
    Option<Profile>{"ideal", Profile::kIdeal}};
constexpr std::array kPreambles = {Option<radio::Preamble>{"long", radio::Preamble::kLong},
                                   Option<radio::Preamble>{"short", radio::Preamble::kShort}};
constexpr std::array kRoundings = {
    Option<radio::Rounding>{"exact", radio::Rounding::kExact},
    Option<radio::Rounding>{"microsecond", radio::Rounding::kMicrosecond}};
constexpr std::array kLengths = {Option<radio::Lengths>{"bytes", radio::Lengths::kBytes},
                                 Option<radio::Lengths>{"fixed", radio::Lengths::kFixed}};
constexpr std::array kErrorModels = {
    Option<radio::ErrorModel>{"mobility_framework", radio::ErrorModel::kMobilityFramework},
    Option<radio::ErrorModel>{"dsss", radio::ErrorModel::kDsss}};

constexpr Range kPowerLevel{-200, 50};      // dBm; thermal noise in 1 Hz is -174
constexpr Range kSensitivity{-130, 0};      // dBm
constexpr Range kNoise{-200, 0};            // dBm
constexpr Range kTxPower{1e-6, 1e5};        // mW
constexpr Range kBitRate{1e3, 1e9};         // b/s
constexpr Range kShortTime{1e-6, 1e-2};     // s
constexpr std::int64_t kMaxBits = 100'000;  // five times the longest MPDU
constexpr std::int64_t kMaxWindow = 32'767;

std::string_view name(Profile profile) {
  return std::find_if(kProfiles.begin(), kProfiles.end(),
                      [profile](const auto& option) { return option.value == profile; })
      ->name;
}

/// Passes on the keys of the profiles for which they mean something.
template <class Io>
class Keys {
 public:
  using Mask = unsigned;
  static constexpr Mask kMf = 1, kB = 2, kDisk = 4, kIdeal = 8;
  static constexpr Mask kWaves = kMf | kB, kRange = kDisk | kIdeal;

  Keys(Io& io, Profile profile) : io_(io), profile_(profile) {}

  bool uses(const std::string& key, Mask mask) {
    if ((mask & (1U << static_cast<unsigned>(profile_))) != 0) return true;
    io_.unused(key, fmt::format("is not used by the profile '{}'", name(profile_)));
    return false;
  }

 private:
  Io& io_;
  Profile profile_;
};

template <class Io>
void propagation_keys(Io& io, RadioConfig& c) {
  using K = Keys<Io>;
  K keys(io, c.profile);
  if (keys.uses("tx_power", K::kWaves | K::kDisk)) {
    io.quantity({"tx_power", "Of a transmitter.", "2 mW"}, "mW", kTxPower, c.tx_power);
  }
  if (keys.uses("wavelength", K::kWaves))
    io.quantity({"wavelength", "Of the carrier.", "0.125 m"}, "m", {1e-3, 10}, c.wavelength);
  if (keys.uses("path_loss_exponent", K::kWaves)) {
    io.number(
        {"path_loss_exponent", "Of the power law (2: free space, Friis), reference 1 m.", "2"}, "1",
        {1, 8}, c.path_loss_exponent);
  }
  if (keys.uses("propagation_delay", K::kWaves))
    io.flag(
        {"propagation_delay", "Whether waves take time: distance over the speed of light.", "true"},
        c.propagation_delay);
  if (keys.uses("obstacles", K::kWaves))
    io.flag({"obstacles", "Whether walls attenuate.", "true"}, c.obstacles);
  const auto level = [&](const Key& key, Range range, hal::Dbm& value) {
    if (keys.uses(key.name, K::kWaves)) io.quantity(key, "dBm", range, value);
  };
  level({"sensitivity", "Weaker frames cannot be received.", "-85 dBm"}, kSensitivity,
        c.sensitivity);
  level({"interference_floor", "Weaker frames do not exist; at most the sensitivity.", "-101 dBm"},
        kPowerLevel, c.interference_floor);
  level({"noise_floor", "Thermal noise and noise figure in the bandwidth.", "-110 dBm"}, kNoise,
        c.noise_floor);
  level({"cca_threshold", "Carrier sense: a frame of this power makes the medium busy.", "-85 dBm"},
        kPowerLevel, c.cca_threshold);
  level(
      {"energy_detection", "Carrier sense: so much power in sum makes the medium busy.", "-62 dBm"},
      kPowerLevel, c.energy_detection);
  if (keys.uses("range", K::kRange))
    io.quantity({"range", "Who is nearer hears every frame, who is farther none.", "250 m"}, "m",
                {1e-3, kUnlimited}, c.range);
}

template <class Io>
void phy_keys(Io& io, RadioConfig& c) {
  using K = Keys<Io>;
  K keys(io, c.profile);
  const auto rate = [&](const Key& key, auto mask, hal::BitsPerSecond& value) {
    if (keys.uses(key.name, mask)) io.quantity(key, "b/s", kBitRate, value);
  };
  rate({"data_rate", "Of data frames; 1, 2, 5.5 or 11 Mb/s where waves are modelled.", "11 Mb/s"},
       K::kWaves | K::kDisk, c.data_rate);
  rate({"control_rate", "Of RTS, CTS and ACK; 1, 2, 5.5 or 11 Mb/s.", "2 Mb/s"}, K::kWaves,
       c.control_rate);
  rate({"broadcast_rate", "Of broadcast frames; 1, 2, 5.5 or 11 Mb/s.", "2 Mb/s"}, K::kWaves,
       c.broadcast_rate);
  if (keys.uses("preamble", K::kWaves))
    io.choice({"preamble", "Of the PHY; a short one not for frames at 1 Mb/s.", "long"}, kPreambles,
              c.preamble);
  if (keys.uses("rounding", K::kWaves))
    io.choice(
        {"rounding",
         "Of airtimes: none below a nanosecond, or up to whole microseconds as in the standard.",
         "microsecond"},
        kRoundings, c.rounding);
  io.choice(
      {"lengths", "Of frames: what the codec puts on the air, or the fixed ones below.", "bytes"},
      kLengths, c.lengths);
  io.count(
      {"fixed_header_bits", "With `lengths: fixed`: MAC header and FCS of a data frame.", "272"}, 0,
      kMaxBits, c.fixed_header_bits);
  io.count({"fixed_payload_bits", "With `lengths: fixed`: a network packet.", "1024"}, 0, kMaxBits,
           c.fixed_payload_bits);
}

template <class Io>
void reception_keys(Io& io, RadioConfig& c) {
  using K = Keys<Io>;
  K keys(io, c.profile);
  if (keys.uses("error_model", K::kWaves))
    io.choice({"error_model", "When a frame is lost to noise and interference.", "dsss"},
              kErrorModels, c.error_model);
  if (keys.uses("min_sinr", K::kWaves))
    io.quantity({"min_sinr",
                 "Lowest usable signal to interference and noise: of the whole frame with "
                 "`error_model: mobility_framework`, of the preamble with `dsss`.",
                 "4 dB"},
                "dB", {-50, 50}, c.min_sinr);
  if (keys.uses("preamble_window", K::kWaves)) {
    io.duration({"preamble_window",
                 "The receiver takes the strongest frame that starts within this time of the "
                 "first; 0 s: the first.",
                 "4 us"},
                {0, 1e-3}, c.preamble_window);
  }
  if (keys.uses("capture_margin", K::kWaves)) {
    io.optional({"capture_margin",
                 "A frame that much stronger takes the receiver over during the other one's "
                 "preamble and PLCP header.",
                 "10 dB"},
                "dB", 0, c.capture_margin);
  }
}

template <class Io>
void mac_keys(Io& io, RadioConfig& c) {
  using K = Keys<Io>;
  K keys(io, c.profile);
  const auto time = [&](const Key& key, hal::Duration& value) {
    if (keys.uses(key.name, K::kWaves)) io.duration(key, kShortTime, value);
  };
  const auto count = [&](const Key& key, auto mask, Range range, std::uint32_t& value) {
    const auto low = static_cast<std::int64_t>(range.low);
    const auto high = static_cast<std::int64_t>(range.high);
    if (keys.uses(key.name, mask)) io.count(key, low, high, value);
  };
  time({"slot", "Of the backoff.", "20 us"}, c.slot);
  time({"sifs", "Short interframe space.", "10 us"}, c.sifs);
  count({"cw_min", "Smallest contention window, one less than a power of two.", "31"}, K::kWaves,
        {0, kMaxWindow}, c.cw_min);
  count({"cw_max", "Largest contention window, one less than a power of two.", "1023"}, K::kWaves,
        {0, kMaxWindow}, c.cw_max);
  count({"cw_broadcast", "Contention window of broadcast frames.", "31"}, K::kMf, {0, kMaxWindow},
        c.cw_broadcast);
  count({"rts_threshold", "Bytes; larger frames use RTS/CTS.", "2347"}, K::kWaves, {0, 1e6},
        c.rts_threshold);
  count({"short_retry_limit", "Transmissions of a frame, or of its RTS, in all.", "7"}, K::kWaves,
        {1, 255}, c.short_retry_limit);
  count({"long_retry_limit", "Transmissions of a data frame after RTS/CTS in all.", "4"}, K::kB,
        {1, 255}, c.long_retry_limit);
  count({"queue_limit", "Frames that may wait in a station.", "14"}, K::kWaves | K::kDisk, {1, 1e6},
        c.queue_limit);
}

template <class Io>
void all_keys(Io& io, RadioConfig& c) {
  propagation_keys(io, c);
  phy_keys(io, c);
  reception_keys(io, c);
  mac_keys(io, c);
}

/// IEEE Std 802.11-2016, 16.2.3.3 and 16.3.2: the rates of DSSS and HR/DSSS.
bool is_dsss_rate(hal::BitsPerSecond rate) {
  return rate.value == 1e6 || rate.value == 2e6 || rate.value == 5.5e6 || rate.value == 11e6;
}

void check_rates(Mapping& in, const RadioConfig& c) {
  const auto check = [&](const char* key, hal::BitsPerSecond rate) {
    if (!is_dsss_rate(rate)) in.mistake(key, "must be 1, 2, 5.5 or 11 Mb/s");
    // IEEE Std 802.11-2016, 16.2.2.3: the short PLCP format starts at 2 Mb/s.
    if (c.preamble == radio::Preamble::kShort && rate.value == 1e6) {
      in.mistake(key, "must be above 1 Mb/s with a short preamble");
    }
  };
  check("data_rate", c.data_rate);
  check("control_rate", c.control_rate);
  check("broadcast_rate", c.broadcast_rate);
}

void check_windows(Mapping& in, const RadioConfig& c) {
  if (c.cw_max < c.cw_min) {
    in.mistake("cw_max", fmt::format("{} is below cw_min, {}", c.cw_max, c.cw_min));
  }
  const auto check = [&](const char* key, std::uint32_t window) {
    if (!std::has_single_bit(window + 1)) {
      in.mistake(key, fmt::format("{} is not one less than a power of two", window));
    }
  };
  check("cw_min", c.cw_min);
  check("cw_max", c.cw_max);
}

void check(Mapping& in, const RadioConfig& c) {
  check_rates(in, c);
  check_windows(in, c);
  if (c.interference_floor > c.sensitivity) {
    in.mistake("interference_floor", fmt::format("{} dBm is above the sensitivity, {} dBm",
                                                 c.interference_floor.value, c.sensitivity.value));
  }
  if (c.noise_floor > c.sensitivity) {
    in.warn("noise_floor", fmt::format("{} dBm is above the sensitivity, {} dBm: what is received "
                                       "at that level drowns in noise",
                                       c.noise_floor.value, c.sensitivity.value));
  }
}

}  // namespace

RadioConfig read_radio(Mapping in) {
  in.integer({"version", "Of the format of this file.", "1"}, 1, 1, 1);
  const std::optional<Profile> profile =
      in.choice({"profile",
                 "The model: the paper's network card, the 802.11b standard, a range and a bit "
                 "rate, or instant and lossless. It sets the defaults.",
                 "ieee80211b"},
                kProfiles);
  if (!profile) return {};  // which of the other keys are right depends on it
  RadioConfig config = radio::profile_defaults(*profile);
  FieldReader reader(in);
  all_keys(reader, config);
  const bool waves =
      config.profile == Profile::kMobilityFramework || config.profile == Profile::kIeee80211b;
  if (waves) check(in, config);
  in.finish();
  return config;
}

void write_radio(Writer& out, const RadioConfig& config) {
  RadioConfig copy = config;
  out.open("radio");
  out.text("profile", name(config.profile));
  FieldWriter writer(out);
  all_keys(writer, copy);
  out.close();
}

}  // namespace sim::scenario
