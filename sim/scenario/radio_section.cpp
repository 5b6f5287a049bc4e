#include "sim/scenario/radio_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "hal/files/config/value.h"
#include "sim/radio/radio_rules.h"
#include "sim/scenario/bss_section.h"
#include "sim/scenario/ht_keys.h"
#include "sim/scenario/loss_section.h"
#include "sim/scenario/propagation_section.h"
#include "sim/scenario/radio_keys.h"

namespace sim::scenario {
namespace {

using radio::RadioConfig;

using radio::Standard;

/// Number of profiles that files can name: all but the last.
constexpr std::size_t kProfiles = std::variant_size_v<RadioConfig> - 1;
static_assert(std::is_same_v<std::variant_alternative_t<kProfiles, RadioConfig>,
                             radio::ForeignProfileConfig>);
const auto kProfileKinds =
    kinds_of<RadioConfig, kProfiles>([](const auto& profile) { return profile.kProfile; });

/// Warns of values that are allowed but probably mistakes.
void warn_of_levels(Mapping& in, const radio::WavesConfig& c) {
  const hal::Dbm noise = c.receiver.noise_floor, sensitivity = c.receiver.sensitivity;
  if (c.propagation.obstacles && c.propagation.antenna_height.value == 0) {
    in.warn("obstacles",
            "has no effect with an antenna_height of 0 m, except on agents with an antenna_height "
            "of their own: walls begin at the ground");
  }
  if (noise > sensitivity) {
    in.warn("noise_floor", fmt::format("{} dBm is above the sensitivity, {} dBm: frames received "
                                       "at the sensitivity are lost in noise",
                                       noise.value, sensitivity.value));
  }
}

void read_basic_rates(Mapping& in, const Key& key, Standard standard, radio::DcfConfig& c) {
  const auto texts = in.texts(key);
  if (!in.has(key.name)) return;
  std::vector<hal::BitsPerSecond> rates;
  for (const hal::files::config::Scalar& text : texts) {
    const auto rate =
        hal::files::config::parse_value(text.text, "b/s", kBitRate.low, kBitRate.high);
    if (!rate || !is_rate(standard, hal::BitsPerSecond{rate.value()})) {
      return in.mistake(key.name, fmt::format("'{}' must be {}", text.text, rates_of(standard)));
    }
    rates.emplace_back(rate.value());
  }
  c.basic_rates = std::move(rates);
}

/// Rates of control responses (IEEE Std 802.11-2016, 10.7.6.5).
void basic_rates_key(Fields& io, Standard standard, radio::DcfConfig& c) {
  const Key key{
      "basic_rates",
      "Basic rates. CTS and ACK are sent at the highest of these that does not exceed "
      "the rate of the frame that they answer, in the same modulation class; if there is "
      "none, at the highest mandatory rate. Frames with an MCS are answered in OFDM, by the "
      "rate of their constellation and code. Not empty.",
      "[1 Mb/s, 2 Mb/s]",
      "[1 Mb/s] (ieee80211b), [6 Mb/s, 12 Mb/s, 24 Mb/s] (ieee80211g and newer)"};
  io.own(
      key, [&](Mapping& in) { read_basic_rates(in, key, standard, c); },
      [&](Writer& out) {
        std::vector<double> rates;
        rates.reserve(c.basic_rates.size());
        for (const hal::BitsPerSecond rate : c.basic_rates) rates.push_back(rate.value);
        out.numbers(key.name, rates, "b/s");
      });
}

void check_rules(Mapping& in, const RadioConfig& config) {
  for (const radio::BrokenRule& rule : radio::broken_rules(config)) {
    const auto dot = rule.key.find('.');
    if (dot == std::string::npos) {
      in.mistake(rule.key, rule.what);
    } else {
      in.within(rule.key.substr(0, dot)).mistake(rule.key.substr(dot + 1), rule.what);
    }
  }
}

/// If no wavelength is given, it follows from the channel, and so does SIFS.
/// @param before  the channel without the key.
void follow_channel(Mapping& in, RadioConfig& config, std::uint32_t before) {
  radio::WavesConfig& waves = *waves_of(config);
  const std::uint32_t channel = waves.phy.channel;
  if (!radio::is_channel(channel)) return;  // check_rules() says so
  const hal::Metres wavelength = waves.propagation.wavelength;
  const hal::Duration sifs = waves.contention.sifs;
  if (radio::HtConfig* const ht = ht_of(config)) {
    waves.phy.channel = before;
    set_channel(*ht, channel);
    if (in.has("sifs")) waves.contention.sifs = sifs;
  }
  waves.propagation.wavelength =
      in.has("wavelength") ? wavelength : radio::wavelength_on(channel, wavelength, before);
}

void waves_keys(Fields& io, RadioConfig& config, radio::WavesConfig& waves, std::uint32_t before) {
  if (io.reading() != nullptr) follow_channel(*io.reading(), config, before);
  chain_keys(io, waves.propagation.chain);
  io.inside({"loss",
             "Random loss of frames that would otherwise be received; recorded as `random loss`."},
            [&](Fields& loss) { keys_of(loss, waves.receiver.loss); });
  if (radio::DcfConfig* const dcf = dcf_of(config)) {
    basic_rates_key(io, *rates_of(config), *dcf);
    io.inside({"bss", "Infrastructure mode: stations send to each other through access points."},
              [&](Fields& bss) {
                keys_of(bss, dcf->bss);
                announced_edca_key(bss, *dcf);
              });
  }
  if (io.reading() != nullptr) warn_of_levels(*io.reading(), waves);
}

void profile_keys(Fields& io, RadioConfig& config) {
  radio::WavesConfig* const waves = waves_of(config);
  const std::uint32_t channel = waves == nullptr ? 0 : waves->phy.channel;
  std::visit([&io](auto& one) { keys_of(io, one); }, config);
  if (waves != nullptr) waves_keys(io, config, *waves, channel);
  if (io.reading() != nullptr) check_rules(*io.reading(), config);
}

/// Refuses the keys that only other profiles use.
void refuse_others(Mapping& in, RadioConfig config) {
  const std::string_view profile = profile_name(config);
  FieldNames mine, all;
  profile_keys(mine, config);
  for (const auto& other : kProfileKinds) {
    RadioConfig made = other.make();
    profile_keys(all, made);
  }
  const bool is_set = in.place("profile").starts_with("--set");
  bool is_any_there = false;
  for (const std::string& key : all.all()) {
    if (mine.has(key)) continue;
    is_any_there = is_any_there || (is_set && in.has(key));
    in.refuse(key, fmt::format("is not used by the profile '{}'", profile));
  }
  if (is_any_there) {
    in.mistake("profile", fmt::format("the other keys of the section are for another profile; this "
                                      "replaces it as a whole: --set 'radio={{profile: {}}}'",
                                      profile));
  }
}

}  // namespace

void keys_of(Fields& io, RadioConfig& config) {
  hal::files::description::version_key(io);
  if (const auto* foreign = std::get_if<radio::ForeignProfileConfig>(&config)) {
    std::string name(foreign->profile);
    io.needed_text({"profile", ""}, name);
    return profile_keys(io, config);
  }
  io.kinds({"profile",
            "Model of the radio, which sets the defaults of the other keys: the network card of "
            "the paper's simulations, IEEE 802.11b, g, n, ac or ax, a disk with a range and a bit "
            "rate, or an ideal one without delay and loss.",
            "ieee80211b"},
           kProfileKinds, config, [](Fields& keys, RadioConfig& one) {
             profile_keys(keys, one);
             if (keys.reading() != nullptr) refuse_others(*keys.reading(), one);
           });
}

std::vector<std::string> profiles_with(bool (*has)(const RadioConfig& config)) {
  std::vector<std::string> names;
  for (const auto& profile : kProfileKinds) {
    if (has(profile.make())) names.emplace_back(profile.name);
  }
  return names;
}

RadioConfig read_radio(Mapping in) {
  RadioConfig config;
  FieldReader reader(in);
  keys_of(reader, config);
  in.finish();
  return config;
}

}  // namespace sim::scenario
