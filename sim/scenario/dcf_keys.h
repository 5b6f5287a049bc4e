#pragma once

#include <array>

#include "sim/scenario/error_table_keys.h"
#include "sim/scenario/queue_keys.h"
#include "sim/scenario/radio_keys.h"

/// The keys of the profiles with the DCF of IEEE Std 802.11; radio_keys.h has those of the others.
namespace sim::scenario {

inline constexpr std::array kRateControls = {
    Option<radio::RateControlKind>{"fixed", radio::RateControlKind::kFixed},
    Option<radio::RateControlKind>{"aarf", radio::RateControlKind::kAarf},
    Option<radio::RateControlKind>{"minstrel", radio::RateControlKind::kMinstrel},
    Option<radio::RateControlKind>{"minstrel_ht", radio::RateControlKind::kMinstrelHt},
    Option<radio::RateControlKind>{"ideal", radio::RateControlKind::kIdeal}};
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
             "Rate of unicast data frames to each destination. fixed: always `data_rate`; aarf: "
             "adaptive auto rate fallback; minstrel: chosen by the measured success of each rate; "
             "minstrel_ht: the same for modes with MCSs, of every width and guard interval; ideal: "
             "the fastest that the SINR at the receiver allows, as if the sender knew it. All use "
             "rates up to `data_rate`, or MCSs up to `mcs`.",
             "minstrel"},
            kRateControls, c.kind);
  io.count({"aarf_threshold",
            "With `aarf`: consecutive successes after which the next higher rate is tried.", "10"},
           1, 1'000'000, c.aarf_threshold);
  io.count({"aarf_max_threshold",
            "With `aarf`: limit to which the threshold doubles while higher rates fail at their "
            "first frame.",
            "50"},
           1, 1'000'000, c.aarf_max_threshold);
  io.count({"aarf_timeout",
            "With `aarf`: transmissions at one rate after which the next higher one is tried in "
            "any case; grows with the threshold.",
            "15"},
           1, 1'000'000, c.aarf_timeout);
  io.duration({"minstrel_interval",
               "With `minstrel` and `minstrel_ht`: time between two evaluations of the statistics.",
               "100 ms"},
              {1e-3, 1e3}, c.minstrel_interval);
  io.number({"minstrel_past",
             "With `minstrel` and `minstrel_ht`: weight of earlier intervals in the running mean.",
             "0.75"},
            "1", {0, 0.999}, c.minstrel_past);
  io.number(
      {"minstrel_sampling", "With `minstrel`: share of frames that probe another rate.", "0.1"},
      "1", kShare, c.minstrel_sampling);
  io.count({"minstrel_ht_wait",
            "With `minstrel_ht`: number of PPDUs between two that probe another mode, to which "
            "twice the mean number of MPDUs in a PPDU is added.",
            "16"},
           0, 1'000'000, c.minstrel_ht_wait);
  io.number({"ideal_loss",
             "With `ideal`: largest share of frames that the chosen mode may lose, of frames with "
             "1200 bytes.",
             "0.01"},
            "1", {1e-9, 0.999}, c.ideal_loss);
}

inline void dcf_keys(Fields& io, radio::DcfConfig& c, DataKey data) {
  common_keys_of(io, c, data);
  io.given({"beacon_rate", "Rate of beacons. One of the data rates.", "1 Mb/s",
            "that of `broadcast_rate`"},
           "b/s", kBitRate, c.beacon_rate);
  io.count(
      {"long_retry_limit",
       "Transmissions of a data frame sent after RTS/CTS, in total, before it is given up.", "4"},
      1, 255, c.long_retry_limit);
  io.duration({"cca_time",
               "Time of carrier sense (aCCATime) plus turnaround (aRxTxTurnaroundTime). A station "
               "whose backoff ends at a slot boundary transmits even if another frame began to "
               "arrive within this time before it. Must be shorter than `slot`.",
               "15 us"},
              {0, 1e-2}, c.cca_time);
  io.choice({"eifs_start",
             "Start of the extended interframe space (EIFS) after an erroneous frame. medium_idle: "
             "when the medium becomes idle, as in the standard; frame_end: at the end of that "
             "frame, even if others are on the air, as in ns-3.",
             "medium_idle"},
            kEifsStarts, c.eifs_start);
  io.choice(
      {"header_error",
       "What follows a frame with an erroneous PHY header. eifs: an extended interframe space, as "
       "after any erroneous frame; forgotten: none, as in ns-3, and if another frame had begun "
       "during its preamble, carrier sense takes the medium for idle until the next frame begins.",
       "eifs"},
      kHeaderErrors, c.receiver.header_error);
  io.optional_duration({"msdu_lifetime",
                        "Time since a frame was queued after which it is given up (`expired`) "
                        "instead of being sent or repeated.",
                        "500 ms"},
                       1e-6, c.msdu_lifetime);
  io.inside({"queues", "Queues of the frames that wait to be sent."},
            [&](Fields& queues) { keys_of(queues, c.queues); });
  keys_of(io, c.rate_control);
}

inline void qos_key(Fields& io, bool& qos) {
  io.flag({"qos",
           "Whether agents are QoS stations, which have a queue for each of four priorities "
           "(`edca`). Those of `ieee80211n` and newer always are.",
           "true"},
          qos);
}

inline void ofdm_keys(Fields& io, radio::Ieee80211gConfig& c) {
  io.choice({"protection",
             "How OFDM frames are protected from stations that support 802.11b only, and frames of "
             "802.11n and newer from stations without it: by a CTS-to-self or an RTS/CTS exchange "
             "before them, at `protection_rate` if there are stations of 802.11b. auto: "
             "cts_to_self if there are such stations on the channel, else none.",
             "auto"},
            kProtections, c.protection);
  io.choice({"bits_at_risk",
             "Bits of an OFDM frame that must arrive without error. mpdu: those of the MPDU; "
             "payload_time: as many as fit between the header and the end of the frame, padding "
             "and signal extension included, as in ns-3.",
             "mpdu"},
            kBitsAtRisk, c.bits_at_risk);
  error_table_key(io, c.error_table);
  io.quantity(
      {"protection_rate", "Rate of the frames that protect: 1, 2, 5.5 or 11 Mb/s.", "1 Mb/s"},
      "b/s", kBitRate, c.protection_rate);
}

}  // namespace sim::scenario
