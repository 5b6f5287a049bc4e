#include "sim/scenario/radio_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "hal/config/value.h"
#include "sim/scenario/bss_section.h"
#include "sim/scenario/dcf_keys.h"
#include "sim/scenario/loss_section.h"
#include "sim/scenario/propagation_section.h"
#include "sim/scenario/radio_keys.h"

namespace sim::scenario {
namespace {

using radio::RadioConfig;

using radio::Standard;

/// Of those that files can name: all but the last.
constexpr std::size_t kProfiles = std::variant_size_v<RadioConfig> - 1;
static_assert(std::is_same_v<std::variant_alternative_t<kProfiles, RadioConfig>,
                             radio::ForeignProfileConfig>);
constexpr auto kAllProfiles = std::make_index_sequence<kProfiles>{};

template <std::size_t... kIndex>
constexpr auto profile_options(std::index_sequence<kIndex...>) {
  return std::array{
      Option<std::size_t>{std::variant_alternative_t<kIndex, RadioConfig>::kProfile, kIndex}...};
}

/// Each of them with its own values.
template <std::size_t... kIndex>
std::array<RadioConfig, kProfiles> profiles(std::index_sequence<kIndex...>) {
  return {RadioConfig(std::in_place_index<kIndex>)...};
}

/// Takes the names of keys only.
class Names {
 public:
  template <class Q>
  void quantity(const Key& key, std::string_view, Range, const Q&) {
    add(key);
  }
  void number(const Key& key, std::string_view, Range, double) { add(key); }
  template <class Q>
  void optional(const Key& key, std::string_view, double, const std::optional<Q>&) {
    add(key);
  }
  void count(const Key& key, std::int64_t, std::int64_t, std::uint32_t) { add(key); }
  void duration(const Key& key, Range, hal::Duration) { add(key); }
  void optional_duration(const Key& key, double, const std::optional<hal::Duration>&) { add(key); }
  void flag(const Key& key, bool) { add(key); }
  template <class Options, class E>
  void choice(const Key& key, const Options&, E) {
    add(key);
  }

  const std::vector<std::string>& all() const { return names_; }
  bool has(const std::string& name) const { return std::ranges::count(names_, name) > 0; }

 private:
  void add(const Key& key) {
    if (!has(key.name)) names_.push_back(key.name);
  }

  std::vector<std::string> names_;
};

void take_names(Names& names, RadioConfig profile) {
  std::visit([&names](auto& one) { keys_of(names, one); }, profile);
}

/// The keys of other profiles mean nothing in this one.
void refuse_others(Mapping& in, FieldReader& reader, const RadioConfig& config) {
  const std::string_view profile = profile_name(config);
  Names mine, all;
  take_names(mine, config);
  for (const RadioConfig& other : profiles(kAllProfiles)) take_names(all, other);
  const bool is_set = in.place("profile").starts_with("--set");
  bool is_any_there = false;
  for (const std::string& key : all.all()) {
    if (mine.has(key)) continue;
    is_any_there = is_any_there || (is_set && in.has(key));
    reader.unused(key, fmt::format("is not used by the profile '{}'", profile));
  }
  if (is_any_there) {
    in.mistake("profile",
               fmt::format("the other keys of the section are for another profile; this replaces "
                           "it as a whole: --set 'radio={{profile: {}}}'",
                           profile));
  }
}

void check_rates(Mapping& in, Standard standard, const radio::PhyConfig& c) {
  const auto check = [&](const char* key, hal::BitsPerSecond rate) {
    if (!is_rate(standard, rate)) {
      in.mistake(key, fmt::format("must be {}", rates_of(standard)));
    }
  };
  check("data_rate", c.data_rate);
  check("control_rate", c.control_rate);
  check("broadcast_rate", c.broadcast_rate);
}

void check_windows(Mapping& in, const radio::ContentionConfig& c) {
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

void check_levels(Mapping& in, const radio::WavesConfig& c) {
  const hal::Dbm floor = c.propagation.interference_floor;
  const hal::Dbm noise = c.receiver.noise_floor, sensitivity = c.receiver.sensitivity;
  if (floor > sensitivity) {
    in.mistake("interference_floor", fmt::format("{} dBm is above the sensitivity, {} dBm",
                                                 floor.value, sensitivity.value));
  }
  if (c.propagation.obstacles && c.propagation.antenna_height.value == 0) {
    in.warn(
        "obstacles",
        "with an antenna_height of 0 m nothing is in the way, except of agents that have one of "
        "their own: walls begin at the ground");
  }
  if (noise > sensitivity) {
    in.warn("noise_floor", fmt::format("{} dBm is above the sensitivity, {} dBm: what is received "
                                       "at that level drowns in noise",
                                       noise.value, sensitivity.value));
  }
}

const Key kBasicRates{"basic_rates",
                      "CTS and ACK are sent at the highest of these that is not above the rate of "
                      "the frame that they answer, in its kind of modulation; if there is none, at "
                      "the highest mandatory rate. Not empty.",
                      "[1 Mb/s, 2 Mb/s]",
                      "[1 Mb/s] (ieee80211b), [6 Mb/s, 12 Mb/s, 24 Mb/s] "
                      "(ieee80211g)"};

void read_basic_rates(Mapping& in, Standard standard, radio::DcfConfig& c) {
  const auto texts = in.texts(kBasicRates);
  if (!in.has(kBasicRates.name)) return;
  c.basic_rates.clear();
  for (const hal::config::Scalar& text : texts) {
    const auto rate = hal::config::parse_value(text.text, "b/s", kBitRate.low, kBitRate.high);
    if (!rate || !is_rate(standard, hal::BitsPerSecond{rate.value()})) {
      return in.mistake(kBasicRates.name,
                        fmt::format("'{}' must be {}", text.text, rates_of(standard)));
    }
    c.basic_rates.emplace_back(rate.value());
  }
  if (c.basic_rates.empty()) in.mistake(kBasicRates.name, "must not be empty");
}

void check_dcf(Mapping& in, const radio::DcfConfig& c) {
  if (!radio::is_dsss_rate(c.protection_rate)) {
    in.mistake("protection_rate", "must be 1, 2, 5.5 or 11 Mb/s");
  }
  if (c.rate_control.aarf_max_threshold < c.rate_control.aarf_threshold) {
    in.mistake("aarf_max_threshold", "must not be below aarf_threshold");
  }
  if (c.cca_time >= c.contention.slot) in.mistake("cca_time", "must be shorter than the slot");
}

void check_waves(Mapping& in, Standard standard, const radio::WavesConfig& c) {
  check_rates(in, standard, c.phy);
  check_windows(in, c.contention);
  check_levels(in, c);
}

/// The list, which the keys of the profiles do not have; its place is behind them.
void read_chain(Mapping& in, RadioConfig& config) {
  radio::WavesConfig* const waves = waves_of(config);
  if (waves == nullptr) {
    const std::string profile(profile_name(config));
    return in.refuse("propagation", "is not used by the profile '" + profile + "'");
  }
  waves->propagation.chain = read_propagation(in, waves->propagation.chain);
}

const Key kBssKey{"bss", "Infrastructure mode: stations send to each other through access points."};
const Key kRandomLoss{
    "loss", "Frames that get lost although the physics let them in; told as `random loss`."};

void read_losses(Mapping& in, RadioConfig& config) {
  if (radio::WavesConfig* const waves = waves_of(config)) {
    waves->receiver.loss = read_loss(in.mapping(kRandomLoss));
    return;
  }
  in.refuse(kRandomLoss.name, fmt::format("is not used by the profile '{}'", profile_name(config)));
}

/// Without a wavelength of its own the carrier follows the number of the channel.
void follow_channel(Mapping& in, RadioConfig& config) {
  radio::WavesConfig* const waves = waves_of(config);
  if (waves == nullptr || in.has("wavelength")) return;
  hal::Metres& wavelength = waves->propagation.wavelength;
  wavelength = radio::wavelength_on(waves->phy.channel, wavelength, 1);
}

}  // namespace

RadioConfig read_radio(Mapping in) {
  in.integer({"version", "Of the format of this file.", "1"}, 1, 1, 1);
  const std::optional<std::size_t> profile = in.choice(
      {"profile",
       "The model: the paper's network card, the 802.11b or 802.11g standard, a range and a bit "
       "rate, or instant and lossless. It sets the defaults.",
       "ieee80211b"},
      profile_options(kAllProfiles));
  if (!profile) return {};  // which of the other keys are right depends on it
  RadioConfig config = profiles(kAllProfiles).at(*profile);
  FieldReader reader(in);
  std::visit([&reader](auto& one) { keys_of(reader, one); }, config);
  follow_channel(in, config);
  read_chain(in, config);
  read_losses(in, config);
  refuse_others(in, reader, config);
  if (radio::DcfConfig* const dcf = dcf_of(config)) {
    read_basic_rates(in, *rates_of(config), *dcf);
    check_dcf(in, *dcf);
    read_bss(in.mapping(kBssKey), dcf->bss);
  } else {
    const std::string why = fmt::format("is not used by the profile '{}'", profile_name(config));
    reader.unused(kBasicRates.name, why);
    reader.unused(kBssKey.name, why);
  }
  if (const radio::WavesConfig* const waves = waves_of(config)) {
    check_waves(in, *rates_of(config), *waves);
  }
  in.finish();
  return config;
}

void write_radio(Writer& out, const RadioConfig& config) {
  RadioConfig copy = config;
  out.open("radio");
  out.text("profile", profile_name(config));
  FieldWriter writer(out);
  std::visit([&writer](auto& one) { keys_of(writer, one); }, copy);
  if (const auto* const waves = waves_of(config)) {
    write_propagation(out, waves->propagation.chain);
    write_loss(out, waves->receiver.loss);
  }
  if (const radio::DcfConfig* const dcf = dcf_of(config)) {
    std::vector<double> rates;
    for (const hal::BitsPerSecond rate : dcf->basic_rates) rates.push_back(rate.value);
    out.numbers(kBasicRates.name, rates, "b/s");
    write_bss(out, dcf->bss);
  }
  out.close();
}

}  // namespace sim::scenario
