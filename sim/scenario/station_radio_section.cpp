#include "sim/scenario/station_radio_section.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <variant>

#include "sim/scenario/bss_section.h"
#include "sim/scenario/override_agents.h"
#include "sim/scenario/radio_keys.h"
#include "sim/scenario/radio_section.h"

namespace sim::scenario {
namespace {

using agents::AgentConfig;
using radio::RadioConfig;
using radio::Standard;
using radio::StationConfig;

constexpr const char* kOfRadio = "that of `radio`";
constexpr std::array kStandards = {Option<Standard>{"ieee80211b", Standard::kIeee80211b},
                                   Option<Standard>{"ieee80211g", Standard::kIeee80211g}};

const Key kStationPower{"tx_power", "Of the transmitters of these agents.", "10 mW", kOfRadio};
const Key kStationHeight{"antenna_height", "Of these agents, above the origin of their body.",
                         "1.5 m", kOfRadio};
const Key kStationGain{"antenna_gain", "Of these agents, to all sides, sending and receiving.",
                       "5 dB", kOfRadio};
const Key kStationChannel{"channel",
                          "Number of the channel of these agents. Who has another one neither "
                          "hears nor disturbs them.",
                          "6", kOfRadio};
const Key kStandard{"standard",
                    "With `profile: ieee80211g`: that these agents know 802.11b only. Frames in "
                    "OFDM are noise to them, and they have the defaults of 802.11b.",
                    "ieee80211b", "ieee80211g"};
const Key kStationDataRate{"data_rate", "Of data frames of these agents.", "11 Mb/s", kOfRadio};
const Key kStationControlRate{"control_rate", "Of RTS of these agents.", "2 Mb/s", kOfRadio};
const Key kStationBss{"bss", "Of these agents, where they are not as `radio.bss` says."};
const Key kStationBroadcastRate{"broadcast_rate", "Of broadcast frames of these agents.", "2 Mb/s",
                                kOfRadio};

bool has_power(const RadioConfig& config) {
  return std::visit(
      [](const auto& one) {
        return requires { one.tx_power; };
      },
      config);
}

/// Of a group, or of one entry of its `overrides`.
class StationReader {
 public:
  StationReader(Mapping& in, const RadioConfig& config) : in_(in), config_(config) {}

  /// What is not there keeps its value.
  void read(StationConfig& station) {
    quantity(kStationPower, "mW", kTxPower, has_power(config_), station.tx_power);
    const bool has_waves = waves_of(config_) != nullptr;
    quantity(kStationHeight, "m", kAntennaHeight, has_waves, station.antenna_height);
    quantity(kStationGain, "dB", kAntennaGain, has_waves, station.antenna_gain);
    channel(has_waves, station.channel);
    standard(station.standard);
    rate(kStationDataRate, has_waves, station);
    rate(kStationControlRate, has_waves, station);
    rate(kStationBroadcastRate, has_waves, station);
    access_points(dcf_of(config_) != nullptr, station);
  }

 private:
  void refuse(const Key& key) {
    in_.refuse(key.name, "is not used by the profile '" + std::string(profile_name(config_)) + "'");
  }

  template <class Q>
  void quantity(const Key& key, std::string_view unit, Range range, bool is_used,
                std::optional<Q>& value) {
    if (!is_used) return refuse(key);
    const double given = in_.number(key, unit, range, range.low);
    if (in_.has(key.name)) value = Q{given};
  }

  void channel(bool is_used, std::optional<std::uint32_t>& value) {
    if (!is_used) return refuse(kStationChannel);
    const std::int64_t given = in_.integer(kStationChannel, 1, radio::kChannels, 1);
    if (in_.has(kStationChannel.name)) value = static_cast<std::uint32_t>(given);
  }

  void access_points(bool is_used, StationConfig& station) {
    if (!is_used) return refuse(kStationBss);
    const auto given = read_own_access_points(in_.mapping(kStationBss));
    if (given) station.access_points = given;
  }

  void standard(std::optional<Standard>& value) {
    if (!std::holds_alternative<radio::Ieee80211gConfig>(config_)) return refuse(kStandard);
    const Standard given = in_.choice(kStandard, kStandards, Standard::kIeee80211g);
    if (in_.has(kStandard.name)) value = given;
  }

  void rate(const Key& key, bool is_used, StationConfig& station) {
    std::optional<hal::BitsPerSecond> given;
    quantity(key, "b/s", kBitRate, is_used, given);
    if (!given) return;
    const Standard rates = station.standard.value_or(*rates_of(config_));
    if (!is_rate(rates, *given)) {
      return in_.mistake(key.name, "must be " + std::string(rates_of(rates)));
    }
    if (key.name == kStationDataRate.name) station.data_rate = given;
    if (key.name == kStationControlRate.name) station.control_rate = given;
    if (key.name == kStationBroadcastRate.name) station.broadcast_rate = given;
  }

  Mapping& in_;
  const RadioConfig& config_;
};

void write_fields(Writer& out, const StationConfig& station) {
  const auto number = [&out](const Key& key, const auto& value, std::string_view unit) {
    if (value) out.number(key.name, value->value, unit);
  };
  number(kStationPower, station.tx_power, "mW");
  number(kStationHeight, station.antenna_height, "m");
  number(kStationGain, station.antenna_gain, "dB");
  if (station.channel) out.integer(kStationChannel.name, *station.channel);
  if (station.standard) FieldWriter(out).choice(kStandard, kStandards, *station.standard);
  number(kStationDataRate, station.data_rate, "b/s");
  number(kStationControlRate, station.control_rate, "b/s");
  number(kStationBroadcastRate, station.broadcast_rate, "b/s");
  write_own_access_points(out, station.access_points);
}

}  // namespace

void read_station_radios(Mapping in, const RadioConfig& config, std::span<AgentConfig> agents) {
  StationConfig common;
  StationReader(in, config).read(common);
  for (AgentConfig& agent : agents) agent.radio = common;
  OverrideAgents some(agents);
  for (Mapping& one : in.mappings({"overrides", "The same for some of the agents; no agent twice.",
                                   "[{agents: NAME0, channel: 11}]"})) {
    const std::vector<AgentConfig*> fitting = some.read(one);
    StationConfig own = common;
    StationReader(one, config).read(own);
    one.finish();
    for (AgentConfig* const agent : fitting) agent->radio = own;
  }
  in.finish();
}

void write_station_radios(Writer& out, std::span<const AgentConfig> agents) {
  const StationConfig& first = agents.front().radio;
  const bool are_equal = std::ranges::all_of(
      agents, [&first](const AgentConfig& agent) { return agent.radio == first; });
  if (are_equal && first == StationConfig{}) return;
  out.open("radio");
  if (are_equal) {
    write_fields(out, first);
  } else {
    out.open_list("overrides");
    for (const AgentConfig& agent : agents) {
      if (agent.radio == StationConfig{}) continue;
      out.open_item();
      out.text("agents", agent.name);
      write_fields(out, agent.radio);
      out.close();
    }
    out.close();
  }
  out.close();
}

}  // namespace sim::scenario
