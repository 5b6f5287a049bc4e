#pragma once

#include <array>

#include "sim/scenario/radio_keys.h"

/// The keys of the profiles with the DCF of IEEE Std 802.11; radio_keys.h has those of the others.
namespace sim::scenario {

inline constexpr std::array kRateControls = {
    Option<radio::RateControlKind>{"fixed", radio::RateControlKind::kFixed},
    Option<radio::RateControlKind>{"aarf", radio::RateControlKind::kAarf},
    Option<radio::RateControlKind>{"minstrel", radio::RateControlKind::kMinstrel}};
inline constexpr std::array kEifsStarts = {
    Option<radio::EifsStart>{"medium_idle", radio::EifsStart::kMediumIdle},
    Option<radio::EifsStart>{"frame_end", radio::EifsStart::kFrameEnd}};
inline constexpr std::array kHeaderErrors = {
    Option<radio::HeaderError>{"eifs", radio::HeaderError::kEifs},
    Option<radio::HeaderError>{"forgotten", radio::HeaderError::kForgotten}};
inline constexpr std::array kProtections = {
    Option<radio::ProtectionKind>{"none", radio::ProtectionKind::kNone},
    Option<radio::ProtectionKind>{"cts_to_self", radio::ProtectionKind::kCtsToSelf},
    Option<radio::ProtectionKind>{"rts_cts", radio::ProtectionKind::kRtsCts},
    Option<radio::ProtectionKind>{"auto", radio::ProtectionKind::kAuto}};

inline void keys_of(Fields& io, radio::RateControlConfig& c) {
  constexpr Range kShare{0, 1};
  io.choice({"rate_control",
             "Of unicast data frames, for each destination: always `data_rate`; adaptive auto rate "
             "fallback; or by the measured success of each rate. The last two go up to "
             "`data_rate`.",
             "minstrel"},
            kRateControls, c.kind);
  io.count(
      {"aarf_threshold", "With `aarf`: successes in a row before it tries a higher rate.", "10"}, 1,
      1'000'000, c.aarf_threshold);
  io.count({"aarf_max_threshold",
            "With `aarf`: to which the threshold doubles while higher rates fail at once.", "50"},
           1, 1'000'000, c.aarf_max_threshold);
  io.count({"aarf_timeout",
            "With `aarf`: transmissions at one rate before it tries a higher one anyway; it grows "
            "as the threshold does.",
            "15"},
           1, 1'000'000, c.aarf_timeout);
  io.duration(
      {"minstrel_interval", "With `minstrel`: after which the statistics are looked at.", "100 ms"},
      {1e-3, 1e3}, c.minstrel_interval);
  io.number({"minstrel_past", "With `minstrel`: weight of what was known before an interval; < 1.",
             "0.75"},
            "1", {0, 0.999}, c.minstrel_past);
  io.number({"minstrel_sampling", "With `minstrel`: share of frames that try another rate.", "0.1"},
            "1", kShare, c.minstrel_sampling);
}

inline void keys_of(Fields& io, radio::DcfConfig& c) {
  common_keys_of(io, c);
  io.count({"long_retry_limit", "Transmissions of a data frame after RTS/CTS in all.", "4"}, 1, 255,
           c.long_retry_limit);
  io.duration(
      {"cca_time",
       "Of carrier sense and turnaround: who is to send at a slot boundary does so whatever "
       "begins to arrive within this time before. Shorter than the slot.",
       "15 us"},
      {0, 1e-2}, c.cca_time);
  io.choice({"eifs_start",
             "When the extended interframe space after a frame that came in wrong begins: as the "
             "medium becomes idle, as in the standard; or, as in ns-3, at the end of that frame, "
             "whatever else is still on the air.",
             "medium_idle"},
            kEifsStarts, c.eifs_start);
  io.choice(
      {"header_error",
       "What follows a frame whose PHY header was wrong: the extended interframe space as "
       "after other wrong frames; or, as in ns-3, none, and if another frame had begun during "
       "its preamble, carrier sense takes the medium for idle until the next one begins.",
       "eifs"},
      kHeaderErrors, c.receiver.header_error);
  io.optional_duration(
      {"msdu_lifetime",
       "Since it was queued: an older frame is given up (`expired`) instead of being sent, or sent "
       "again.",
       "500 ms"},
      1e-6, c.msdu_lifetime);
  keys_of(io, c.rate_control);
}

inline void keys_of(Fields& io, radio::Ieee80211bConfig& c) {
  keys_of(io, static_cast<radio::DcfConfig&>(c));
  error_model(io, c.receiver.error_model);
  rounding(io, c.phy.rounding);
}

inline void keys_of(Fields& io, radio::Ieee80211gConfig& c) {
  keys_of(io, static_cast<radio::DcfConfig&>(c));
  io.choice({"protection",
             "Of frames in OFDM from agents that know 802.11b only: a CTS to oneself or RTS/CTS "
             "before them, at a rate that all know. auto: cts_to_self if there are such agents on "
             "the channel, else none.",
             "auto"},
            kProtections, c.protection);
  io.choice({"bits_at_risk",
             "What must arrive of an OFDM frame: the bits of the MPDU; or, as in ns-3, as many as "
             "fit between the header and the frame's end, pad and signal extension included.",
             "mpdu"},
            kBitsAtRisk, c.bits_at_risk);
  io.quantity({"protection_rate", "Of what protects; 1, 2, 5.5 or 11 Mb/s.", "1 Mb/s"}, "b/s",
              kBitRate, c.protection_rate);
}

}  // namespace sim::scenario
