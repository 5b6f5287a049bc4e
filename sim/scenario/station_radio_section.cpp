#include "sim/scenario/station_radio_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <variant>

#include "sim/radio/radio_rules.h"
#include "sim/scenario/antenna_keys.h"
#include "sim/scenario/bss_section.h"
#include "sim/scenario/ht_keys.h"
#include "sim/scenario/override_agents.h"
#include "sim/scenario/radio_section.h"

namespace sim::scenario {
namespace {

using agents::AgentConfig;
using radio::RadioConfig;
using radio::Standard;
using radio::StationConfig;

constexpr const char* kOfRadio = "that of `radio`";
constexpr std::array kStandards = {Option<Standard>{"ieee80211b", Standard::kIeee80211b},
                                   Option<Standard>{"ieee80211g", Standard::kIeee80211g},
                                   Option<Standard>{"ieee80211n", Standard::kIeee80211n},
                                   Option<Standard>{"ieee80211ac", Standard::kIeee80211ac},
                                   Option<Standard>{"ieee80211ax", Standard::kIeee80211ax}};

bool has_power(const RadioConfig& config) {
  return std::visit(
      [](const auto& one) {
        return requires { one.tx_power; };
      },
      config);
}

bool has_waves(const RadioConfig& config) { return waves_of(config) != nullptr; }
bool has_dcf(const RadioConfig& config) { return dcf_of(config) != nullptr; }
bool has_ofdm(const RadioConfig& config) { return ofdm_of(config) != nullptr; }
bool has_mcs(const RadioConfig& config) { return ht_of(config) != nullptr; }

/// Keys that exist only in some profiles.
void used_keys(Fields& io, bool (*is_used)(const RadioConfig&), const RadioConfig& config,
               const std::function<void(Fields&)>& body) {
  io.only(is_used(config), {".radio.profile", profiles_with(is_used)},
          fmt::format("is not used by the profile '{}'", profile_name(config)), body);
}

void antenna_keys(Fields& io, StationConfig& c) {
  io.given({"antenna_height", "Antenna height of these agents above the origin of their body.",
            "1.5 m", kOfRadio},
           "m", kAntennaHeight, c.antenna_height);
  io.given(
      {"antenna_gain",
       "Antenna gain of these agents, the same in all directions, for transmission and reception.",
       "5 dB", kOfRadio},
      "dB", kAntennaGain, c.antenna_gain);
  antenna_key(io, c.antenna);
  io.given_count({"channel",
                  "Number of the channel of these agents. Agents on different channels neither "
                  "receive nor disturb each other.",
                  "6", kOfRadio},
                 1, radio::kLastChannel, c.channel);
}

void standard_key(Fields& io, StationConfig& c) {
  io.given_choice(
      {"standard",
       "With `profile: ieee80211g` or newer: standard that these agents support, that of the "
       "profile "
       "or an older one that exists in the band; in the 5 GHz band ieee80211g is 802.11a. Those "
       "with "
       "ieee80211b have the defaults of 802.11b. Frames in a format that agents do not support are "
       "only energy to them.",
       "ieee80211b", "that of `radio`"},
      kStandards, c.standard);
}

void mcs_keys(Fields& io, StationConfig& c) {
  io.given_count({"mcs", "MCS of these agents' data frames.", "3", kOfRadio}, 0, 11, c.mcs);
  io.given_count({"streams", "Spatial streams and antennas of these agents.", "1", kOfRadio}, 1, 4,
                 c.streams);
  io.given_choice({"width", "Widest channel that these agents support.", "20 MHz", kOfRadio},
                  kWidths, c.width);
}

/// Notes what the rules of a radio exclude.
void check_station(Fields& io, const StationConfig& c, const RadioConfig& config) {
  if (io.reading() == nullptr) return;
  for (const radio::BrokenRule& rule : radio::broken_rules(config, c)) {
    if (io.reading()->has(rule.key)) io.mistake(rule.key, rule.what);
  }
}

void rate_keys(Fields& io, StationConfig& c, const RadioConfig& config) {
  const auto rate = [&](const Key& key, std::optional<hal::BitsPerSecond>& value) {
    std::optional<hal::BitsPerSecond> given = value;
    if (!io.given(key, "b/s", kBitRate, given)) return;
    const Standard rates = c.standard.value_or(*rates_of(config));
    if (is_rate(rates, *given)) {
      value = given;
    } else {
      io.mistake(key.name, fmt::format("must be {}", rates_of(rates)));
    }
  };
  rate({"data_rate", "Rate of these agents' data frames.", "11 Mb/s", kOfRadio}, c.data_rate);
  rate({"control_rate", "Rate of these agents' RTS frames.", "2 Mb/s", kOfRadio}, c.control_rate);
  rate({"broadcast_rate", "Rate of these agents' broadcast frames.", "2 Mb/s", kOfRadio},
       c.broadcast_rate);
}

/// The keys for a group, or for one entry of its `overrides`. Keys that are absent leave their
/// value unchanged.
/// @param config  determines which keys exist.
void keys_of(Fields& io, StationConfig& c, const RadioConfig& config) {
  used_keys(io, has_power, config, [&](Fields& used) {
    used.given({"tx_power", "Transmit power of these agents.", "10 mW", kOfRadio}, "mW", kTxPower,
               c.tx_power);
  });
  used_keys(io, has_waves, config, [&](Fields& used) { antenna_keys(used, c); });
  used_keys(io, has_ofdm, config, [&](Fields& used) { standard_key(used, c); });
  used_keys(io, has_mcs, config, [&](Fields& used) { mcs_keys(used, c); });
  used_keys(io, has_waves, config, [&](Fields& used) { rate_keys(used, c, config); });
  used_keys(io, has_dcf, config,
            [&](Fields& used) { own_access_points_key(used, c.access_points); });
  check_station(io, c, config);
}

/// Settings for the radios of some of the agents.
struct RadioOverride {
  std::string agents;
  StationConfig radio;
};

void override_keys(Fields& io, std::span<AgentConfig> agents, const StationConfig& common,
                   std::vector<RadioOverride> overrides, const RadioConfig& config) {
  OverrideAgents some(agents);
  io.list_if_any<RadioOverride>(
      {"overrides", "The same keys for some of the agents. No agent may be in two entries.",
       "[{agents: NAME0, channel: 11}]"},
      overrides,
      [&](Fields& one, RadioOverride& c) {
        const auto fitting = some.agents_key(one, c.agents);
        keys_of(one, c.radio, config);
        for (AgentConfig* const agent : fitting) agent->radio = c.radio;
      },
      {{}, common});
}

}  // namespace

void station_radio_key(Fields& io, std::span<AgentConfig> agents, const RadioConfig& config) {
  const auto has_own = [](const AgentConfig& agent) { return agent.radio != StationConfig{}; };
  const bool are_equal = std::ranges::all_of(
      agents, [&](const AgentConfig& agent) { return agent.radio == agents.front().radio; });
  StationConfig common;
  std::vector<RadioOverride> overrides;
  if (io.is_writing()) {
    if (are_equal) {
      common = agents.front().radio;
    } else {
      for (const AgentConfig& agent : agents)
        if (has_own(agent)) overrides.push_back({agent.name, agent.radio});
    }
  }
  io.written_if(std::ranges::any_of(agents, has_own), [&](Fields& written) {
    written.inside(
        {"radio", "Radio keys in which the group's agents differ from `radio` of the scenario."},
        [&](Fields& radio) {
          keys_of(radio, common, config);
          if (radio.reading() != nullptr)
            for (AgentConfig& agent : agents) agent.radio = common;
          override_keys(radio, agents, common, overrides, config);
        });
  });
}

}  // namespace sim::scenario
