#pragma once

#include <array>
#include <cstdint>

#include "sim/radio/radio_config.h"
#include "sim/scenario/antenna_keys.h"
#include "sim/scenario/fields.h"

/// The keys of a radio. Each part of a profile has a function that reads or writes its keys through
/// Fields.
namespace sim::scenario {

inline constexpr std::array kPreambles = {
    Option<radio::Preamble>{"long", radio::Preamble::kLong},
    Option<radio::Preamble>{"short", radio::Preamble::kShort}};
inline constexpr std::array kRoundings = {
    Option<radio::Rounding>{"exact", radio::Rounding::kExact},
    Option<radio::Rounding>{"microsecond", radio::Rounding::kMicrosecond}};
inline constexpr std::array kLengths = {Option<radio::Lengths>{"bytes", radio::Lengths::kBytes},
                                        Option<radio::Lengths>{"fixed", radio::Lengths::kFixed}};
inline constexpr std::array kBitsAtRisk = {
    Option<radio::BitsAtRisk>{"mpdu", radio::BitsAtRisk::kMpdu},
    Option<radio::BitsAtRisk>{"payload_time", radio::BitsAtRisk::kPayloadTime}};
inline constexpr std::array kErrorModels = {
    Option<radio::ErrorModel>{"mobility_framework", radio::ErrorModel::kMobilityFramework},
    Option<radio::ErrorModel>{"dsss", radio::ErrorModel::kDsss}};

inline constexpr Range kPowerLevel{-200, 50};      // dBm; thermal noise in 1 Hz is -174
inline constexpr Range kSensitivity{-130, 0};      // dBm
inline constexpr Range kAntennaHeight{0, 1000};    // m
inline constexpr Range kAntennaGain{-50, 50};      // dB
inline constexpr Range kObstacleLoss{0, 1000};     // dB, dB/m
inline constexpr Range kNoise{-200, 0};            // dBm
inline constexpr Range kTxPower{1e-6, 1e5};        // mW
inline constexpr Range kBitRate{1e3, 1e9};         // b/s
inline constexpr Range kShortTime{1e-6, 1e-2};     // s
inline constexpr std::int64_t kMaxBits = 100'000;  // five times the longest MPDU
inline constexpr std::int64_t kMaxWindow = 32'767;

inline void antenna_height(Fields& io, hal::Metres& height) {
  io.quantity(
      {"antenna_height",
       "Height of the antennas above the origin of their body, which is on the ground.", "1.5 m"},
      "m", kAntennaHeight, height);
}

inline void keys_of(Fields& io, radio::PropagationConfig& c) {
  io.quantity({"wavelength",
               "Wavelength of the carrier on the radio's `channel`. The default of a profile is "
               "for channel 1.",
               "0.125 m"},
              "m", {1e-3, 10}, c.wavelength);
  io.number({"path_loss_exponent",
             "Exponent of the model `power_law`, with free space up to the reference distance of 1 "
             "m; 2: free space everywhere (Friis).",
             "2"},
            "1", {1, 8}, c.path_loss_exponent);
  io.flag({"propagation_delay",
           "Whether signals travel at the speed of light; if not, they arrive at once.", "true"},
          c.propagation_delay);
  antenna_height(io, c.antenna_height);
  io.quantity(
      {"antenna_gain",
       "Gain of the antennas, the same in all directions, for transmission and reception.", "2 dB"},
      "dB", kAntennaGain, c.antenna_gain);
  antenna_key(io, c.antenna);
  io.flag({"obstacles",
           "Whether walls and bodies attenuate: walls by their `radio_loss`, bodies by the two "
           "keys below. With the propagation model `multi_wall`, which has the walls, only bodies.",
           "true"},
          c.obstacles);
  io.quantity({"body_loss_per_crossing",
               "With `obstacles: true`: loss through each body of a robot or mote between the two "
               "agents, whose own bodies do not count. Computed at the start of a frame.",
               "5 dB"},
              "dB", kObstacleLoss, c.body_loss.per_crossing);
  io.number({"body_loss_per_metre",
             "With `obstacles: true`: further loss for each metre inside such a body.", "10 dB/m"},
            "dB/m", kObstacleLoss, c.body_loss.per_metre);
  io.quantity(
      {"interference_floor",
       "Frames received below this power are ignored, even as interference; at most `sensitivity`.",
       "-101 dBm"},
      "dBm", kPowerLevel, c.interference_floor);
}

inline void keys_of(Fields& io, radio::ReceiverConfig& c) {
  const auto level = [&io](const Key& key, Range range, hal::Dbm& value) {
    io.quantity(key, "dBm", range, value);
  };
  level({"sensitivity", "Lowest received power at which a frame can be decoded.", "-85 dBm"},
        kSensitivity, c.sensitivity);
  level({"noise_floor",
         "Power of thermal noise in the bandwidth, with the receiver's noise figure.", "-110 dBm"},
        kNoise, c.noise_floor);
  level({"cca_threshold",
         "Carrier sense: a single frame received at this power or more makes the medium busy.",
         "-85 dBm"},
        kPowerLevel, c.cca_threshold);
  level({"energy_detection",
         "Carrier sense: total received power, decodable or not, that makes the medium busy.",
         "-62 dBm"},
        kPowerLevel, c.energy_detection);
  io.quantity({"min_sinr",
               "Lowest usable ratio of signal to interference and noise (SINR): of the whole frame "
               "with `error_model: mobility_framework`, of the preamble with `dsss`.",
               "4 dB"},
              "dB", {-50, 50}, c.min_sinr);
  io.duration({"preamble_window",
               "The receiver synchronises to the strongest of the frames that start within this "
               "time after the first one; 0 s: to the first.",
               "4 us"},
              {0, 1e-3}, c.preamble_window);
  io.optional({"capture_margin",
               "A frame that is stronger by this margin captures the receiver within "
               "`capture_window`; none: no capture.",
               "10 dB"},
              "dB", 0, c.capture_margin);
  io.duration(
      {"capture_window",
       "Time after synchronising to a frame during which another one can capture the receiver.",
       "16 us"},
      {0, 1e-2}, c.capture_window);
}

inline void error_model(Fields& io, radio::ErrorModel& model) {
  io.choice(
      {"error_model",
       "Which packet error model decides whether noise and interference destroy a frame.", "dsss"},
      kErrorModels, model);
}

inline void data_rate(Fields& io, hal::BitsPerSecond& rate) {
  io.quantity({"data_rate",
               "Rate of unicast data frames: 1, 2, 5.5 or 11 Mb/s; with `ieee80211g` also 6, 9, "
               "12, 18, 24, 36, 48 or 54 Mb/s; with `disk` any.",
               "11 Mb/s"},
              "b/s", kBitRate, rate);
}

/// Whether unicast data have one rate, or a mode with an MCS.
enum class DataKey : std::uint8_t { kRate, kMcs };

inline void phy_keys(Fields& io, radio::PhyConfig& c, DataKey data) {
  io.count({"channel",
            "Number of the channel in the 2.4 GHz band, 1 to 14; with `ieee80211n` and "
            "`ieee80211ax` also in the 5 GHz band, 36 to 165, with `ieee80211ac` only there. Of a "
            "wider channel the primary one. Agents on different channels neither receive nor "
            "disturb each other; leakage into adjacent channels is not modelled.",
            "6"},
           1, radio::kLastChannel, c.channel);
  if (data == DataKey::kRate) data_rate(io, c.data_rate);
  io.quantity(
      {"control_rate",
       "Rate of RTS frames; with `mobility_framework` also of CTS and ACK. One of the data rates.",
       "2 Mb/s"},
      "b/s", kBitRate, c.control_rate);
  io.quantity({"broadcast_rate", "Rate of broadcast frames. One of the data rates.", "2 Mb/s"},
              "b/s", kBitRate, c.broadcast_rate);
  io.choice(
      {"preamble",
       "DSSS preamble of frames at 2, 5.5 and 11 Mb/s; frames at 1 Mb/s always have the long one.",
       "long"},
      kPreambles, c.preamble);
}

inline void rounding(Fields& io, radio::Rounding& value) {
  io.choice({"rounding",
             "Rounding of frame durations: exact, to the nearest nanosecond; microsecond, up to "
             "whole microseconds as in the standard.",
             "microsecond"},
            kRoundings, value);
}

inline void keys_of(Fields& io, radio::LengthsConfig& c) {
  io.choice({"lengths",
             "Length of frames on the air: bytes, that of the encoded frame; fixed, the two values "
             "below.",
             "bytes"},
            kLengths, c.lengths);
  io.count({"fixed_header_bits",
            "With `lengths: fixed`: length of MAC header and FCS of a data frame, in bits.", "272"},
           0, kMaxBits, c.header_bits);
  io.count(
      {"fixed_payload_bits",
       "With `lengths: fixed`: length of a network packet in bits, whatever it carries.", "1024"},
      0, kMaxBits, c.payload_bits);
}

inline void queue_limit(Fields& io, std::uint32_t& limit) {
  io.count({"queue_limit",
            "Frames that may wait in the queue of a station; further ones are dropped.", "14"},
           1, 1'000'000, limit);
}

inline void keys_of(Fields& io, radio::ContentionConfig& c) {
  io.duration({"slot", "Slot time of the backoff.", "20 us"}, kShortTime, c.slot);
  io.duration({"sifs",
               "Short interframe space (SIFS). With n, ac and ax its default follows the band of "
               "the channel.",
               "10 us"},
              kShortTime, c.sifs);
  io.count({"cw_min", "Smallest contention window in slots, one less than a power of two.", "31"},
           0, kMaxWindow, c.cw_min);
  io.count({"cw_max", "Largest contention window in slots, one less than a power of two.", "1023"},
           0, kMaxWindow, c.cw_max);
  io.count(
      {"rts_threshold",
       "Length of a unicast PSDU (a frame, or an A-MPDU) in bytes above which RTS/CTS precedes it.",
       "2347"},
      0, 10'000'000, c.rts_threshold);
  io.count({"short_retry_limit",
            "Transmissions of a frame without RTS/CTS, or of an RTS, in total, before the frame is "
            "given up.",
            "7"},
           1, 255, c.short_retry_limit);
  queue_limit(io, c.queue_limit);
}

inline void tx_power(Fields& io, hal::Milliwatts& power) {
  io.quantity({"tx_power", "Transmit power.", "2 mW"}, "mW", kTxPower, power);
}

inline void range(Fields& io, hal::Metres& range) {
  io.quantity(
      {"range", "Range of the radio: agents within it receive every frame, others none.", "250 m"},
      "m", {1e-3, kUnlimited}, range);
}

inline void common_keys_of(Fields& io, radio::WavesConfig& c, DataKey data = DataKey::kRate) {
  tx_power(io, c.tx_power);
  keys_of(io, c.propagation);
  keys_of(io, c.receiver);
  phy_keys(io, c.phy, data);
  keys_of(io, c.lengths);
  keys_of(io, c.contention);
}

inline void keys_of(Fields& io, radio::MobilityFrameworkConfig& c) {
  common_keys_of(io, c);
  error_model(io, c.receiver.error_model);
  rounding(io, c.phy.rounding);
  io.count({"cw_broadcast", "Contention window of broadcast frames, in slots.", "31"}, 0,
           kMaxWindow, c.cw_broadcast);
}

inline void keys_of(Fields& io, radio::ForeignProfileConfig& c) {
  common_keys_of(io, c);
  error_model(io, c.receiver.error_model);
  rounding(io, c.phy.rounding);
}

inline void keys_of(Fields& io, radio::DiskConfig& c) {
  tx_power(io, c.tx_power);
  range(io, c.range);
  data_rate(io, c.data_rate);
  keys_of(io, c.lengths);
  queue_limit(io, c.queue_limit);
}

inline void keys_of(Fields& io, radio::IdealConfig& c) {
  range(io, c.range);
  keys_of(io, c.lengths);
}

}  // namespace sim::scenario
