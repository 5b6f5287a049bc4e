#pragma once

#include <array>

#include "sim/scenario/dcf_keys.h"

/// The keys of EDCA, and of the profiles with MCSs.
namespace sim::scenario {

inline constexpr std::array kWidths = {Option<std::uint16_t>{"20 MHz", 20},
                                       Option<std::uint16_t>{"40 MHz", 40},
                                       Option<std::uint16_t>{"80 MHz", 80}};
inline constexpr std::array kGuards = {Option<hal::Duration>{"400 ns", hal::Duration{400}},
                                       Option<hal::Duration>{"800 ns", hal::Duration{800}},
                                       Option<hal::Duration>{"1600 ns", hal::Duration{1600}},
                                       Option<hal::Duration>{"3200 ns", hal::Duration{3200}}};
inline constexpr std::array kPpduTimes = {
    Option<radio::PpduTimes>{"standard", radio::PpduTimes::kStandard},
    Option<radio::PpduTimes>{"ns3", radio::PpduTimes::kNs3}};

inline void contention_keys(Fields& io, radio::AccessParameters& c) {
  io.count({"cw_min", "Smallest contention window in slots, one less than a power of two.", "15"},
           0, kMaxWindow, c.cw_min);
  io.count({"cw_max", "Largest contention window in slots, one less than a power of two.", "1023"},
           0, kMaxWindow, c.cw_max);
  io.count({"aifsn", "Slots after SIFS before the backoff (AIFSN).", "3"}, 1, 15, c.aifsn);
  io.duration({"txop_limit",
               "Longest time for which the category may hold the medium; 0 s: one frame exchange.",
               "4.096 ms"},
              {0, 0.1}, c.txop_limit);
}

inline void lifetime_key(Fields& io, radio::AccessParameters& c) {
  io.optional_duration({"msdu_lifetime",
                        "Lifetime of frames of this category, as in `msdu_lifetime` of the radio; "
                        "none: that one.",
                        "50 ms"},
                       1e-6, c.msdu_lifetime);
}

/// @param with_lifetime  of a station itself, not of what is announced to others.
inline void keys_of(Fields& io, radio::EdcaConfig& c, bool with_lifetime) {
  const auto category = [&](const Key& key, radio::AccessCategory which) {
    io.inside(key, [&](Fields& one) {
      contention_keys(one, c.of(which));
      if (with_lifetime) lifetime_key(one, c.of(which));
    });
  };
  category({"background", "Access category AC_BK: user priorities 1 and 2."},
           radio::AccessCategory::kBackground);
  category({"best_effort", "Access category AC_BE: user priorities 0 and 3."},
           radio::AccessCategory::kBestEffort);
  category({"video", "Access category AC_VI: user priorities 4 and 5."},
           radio::AccessCategory::kVideo);
  category({"voice", "Access category AC_VO: user priorities 6 and 7."},
           radio::AccessCategory::kVoice);
}

inline void edca_keys(Fields& io, radio::EdcaConfig& c) {
  io.inside({"edca", "Contention of the four access categories of a QoS station."},
            [&](Fields& edca) { keys_of(edca, c, true); });
}

/// In `bss`. What is not given is that of the radio.
inline void announced_edca_key(Fields& io, radio::DcfConfig& c) {
  radio::EdcaConfig edca = c.bss.edca.value_or(c.edca);
  const bool is_there =
      io.inside_given({"edca",
                       "Contention that access points announce to QoS stations, which use it "
                       "instead of the radio's "
                       "while they are associated; the access points themselves do not.",
                       "", "that of the radio"},
                      c.bss.edca.has_value(), [&](Fields& one) { keys_of(one, edca, false); });
  if (is_there) c.bss.edca = edca;
}

inline void keys_of(Fields& io, radio::AggregationConfig& c) {
  io.count({"max_ampdu", "Longest A-MPDU in bytes; 0: none is sent.", "65535"}, 0, 6'500'631,
           c.max_ampdu);
  io.count({"max_amsdu", "Longest A-MSDU in bytes; 0: none is sent.", "3839"}, 0, 11'454,
           c.max_amsdu);
  io.count({"block_ack_window",
            "Frames that a station may send before the first of them is acknowledged: at most 64, "
            "with `ieee80211ax` 256.",
            "64"},
           1, 256, c.block_ack_window);
  io.duration({"reorder_timeout",
               "How long a receiver waits for a missing frame before it passes on those after it.",
               "100 ms"},
              {1e-6, 10}, c.reorder_timeout);
}

inline void width_key(Fields& io, std::uint16_t& width) {
  io.choice({"width", "Width of the channel of data frames, around or above `channel`.", "40 MHz"},
            kWidths, width);
}

inline void keys_of(Fields& io, radio::McsConfig& c) {
  io.count({"mcs",
            "Modulation and coding scheme of unicast data frames, for each stream: 0 to 7, with "
            "`ieee80211ac` to 9, with `ieee80211ax` to 11; with rate control, the highest one. For "
            "agents that support less, the same or the next lower one of the newest format that "
            "both support.",
            "7"},
           0, 11, c.mcs);
  io.count({"streams", "Spatial streams of unicast data frames, and antennas of each agent.", "2"},
           1, 4, c.streams);
  width_key(io, c.width);
  io.choice({"guard_interval",
             "Guard interval of data frames: 400 ns or 800 ns; with `ieee80211ax` 800 ns, 1600 ns "
             "or 3200 ns.",
             "800 ns"},
            kGuards, c.guard);
  io.choice({"ppdu_times",
             "How long frames with an MCS last. standard: as in the standard; ns3: as in ns-3.37, "
             "which does not round up to 4 us after short guard intervals, leaves out VHT-SIG-B, "
             "and has HE training fields of 8 us.",
             "standard"},
            kPpduTimes, c.times);
}

inline void wide_protection_key(Fields& io, bool& is_protected) {
  io.flag(
      {"wide_protection",
       "With `protection: auto`: whether frames wider than 20 MHz are protected by a CTS-to-self "
       "where an agent with HT has only 20 MHz (20 MHz protection mode), as drivers of Linux do. "
       "The standard does not ask for it: such agents defer to wider frames.",
       "true"},
      is_protected);
}

inline void keys_of(Fields& io, radio::HtConfig& c) {
  dcf_keys(io, c, DataKey::kMcs);
  ofdm_keys(io, c);
  wide_protection_key(io, c.wide_protection);
  edca_keys(io, c.edca);
  keys_of(io, c.mcs);
  io.inside({"aggregation", "A-MPDU, A-MSDU and Block Ack."},
            [&](Fields& aggregation) { keys_of(aggregation, c.aggregation); });
}

inline void keys_of(Fields& io, radio::Ieee80211nConfig& c) {
  keys_of(io, static_cast<radio::HtConfig&>(c));
}
inline void keys_of(Fields& io, radio::Ieee80211acConfig& c) {
  keys_of(io, static_cast<radio::HtConfig&>(c));
}
inline void keys_of(Fields& io, radio::Ieee80211axConfig& c) {
  keys_of(io, static_cast<radio::HtConfig&>(c));
}

inline void keys_of(Fields& io, radio::Ieee80211bConfig& c) {
  dcf_keys(io, c, DataKey::kRate);
  qos_key(io, c.qos);
  edca_keys(io, c.edca);
  error_model(io, c.receiver.error_model);
  rounding(io, c.phy.rounding);
}

inline void keys_of(Fields& io, radio::Ieee80211gConfig& c) {
  dcf_keys(io, c, DataKey::kRate);
  qos_key(io, c.qos);
  edca_keys(io, c.edca);
  ofdm_keys(io, c);
}

}  // namespace sim::scenario
