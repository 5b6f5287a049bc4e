#include "results/record/radiotap.h"

#include <algorithm>
#include <cmath>

#include "results/record/radiotap_phy.h"
#include "sim/radio/mac/codec.h"

namespace results::record {
namespace {

// Bit numbers of the fields. Each field is aligned to its size.
constexpr int kTsft = 0;
constexpr int kFlags = 1;
constexpr int kRate = 2;
constexpr int kChannel = 3;
constexpr int kSignal = 5;
constexpr int kNoise = 6;

constexpr std::uint8_t kShortPreamble = 0x02;
constexpr std::uint8_t kFcsAtEnd = 0x10;

constexpr std::uint16_t kCck = 0x0020;
constexpr std::uint16_t kOfdm = 0x0040;
constexpr std::uint16_t k2GHz = 0x0080;
constexpr std::uint16_t k5GHz = 0x0100;

/// Short preamble of DSSS: 72 us; the long one has 144 us (IEEE Std 802.11-2016, 16.2.2).
constexpr hal::Duration kShortDsssPreamble = std::chrono::microseconds{72};

template <class Integer>
void put_field(hal::Bytes& out, Integer value) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    out.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i)));
  }
}

sim::radio::ModulationClass modulation_of(const sim::radio::Frame& frame) {
  return frame.mode == nullptr ? sim::radio::ModulationClass::kNone
                               : frame.mode->modulation_class();
}

std::uint8_t flags_of(const sim::radio::Frame& frame) {
  const bool is_short = modulation_of(frame) == sim::radio::ModulationClass::kDsss &&
                        frame.mode->preamble() == kShortDsssPreamble;
  return static_cast<std::uint8_t>(kFcsAtEnd | (is_short ? kShortPreamble : 0));
}

/// In units of 500 kb/s; none if the rate is not a multiple, does not fit, or is of an MCS.
std::optional<std::uint8_t> rate_of(const sim::radio::Frame& frame) {
  if (sim::radio::has_streams(modulation_of(frame))) return std::nullopt;
  const double units = frame.rate.value / 500e3;
  if (units < 1 || units > 127 || units != std::floor(units)) return std::nullopt;
  return static_cast<std::uint8_t>(units);
}

std::uint16_t channel_flags(const sim::radio::Frame& frame, std::uint16_t frequency) {
  std::uint16_t flags = frequency < 4000 ? k2GHz : k5GHz;
  if (modulation_of(frame) == sim::radio::ModulationClass::kDsss) flags |= kCck;
  if (modulation_of(frame) >= sim::radio::ModulationClass::kOfdm) flags |= kOfdm;
  return flags;
}

std::uint8_t whole_dbm(double dbm) {
  return static_cast<std::uint8_t>(
      static_cast<std::int8_t>(std::clamp(std::round(dbm), -128.0, 127.0)));
}

RadiotapPhy phy_of(sim::radio::ModulationClass modulation) {
  switch (modulation) {
    case sim::radio::ModulationClass::kHt:
      return RadiotapPhy::kHt;
    case sim::radio::ModulationClass::kVht:
      return RadiotapPhy::kVht;
    default:
      return RadiotapPhy::kHe;
  }
}

/// HE-LTFs as in sim::radio::HeMode: 2x, but 4x with the longest guard interval.
std::optional<int> he_ltf_of(const sim::radio::ModeId& mode) {
  if (mode.modulation != sim::radio::ModulationClass::kHe) return std::nullopt;
  constexpr hal::Duration kLongestGuard = std::chrono::nanoseconds{3200};
  return mode.guard == kLongestGuard ? 12800 : 6400;
}

/// @return the bits of `it_present` for what was appended.
std::uint32_t put_mode(hal::Bytes& header, const sim::radio::Frame& frame, std::uint32_t ampdu) {
  if (!sim::radio::has_streams(modulation_of(frame))) return 0;
  const sim::radio::ModeId& mode = frame.mode->id();
  std::optional<RadiotapAmpdu> place;
  if (frame.ampdu != 0) {
    place = RadiotapAmpdu{.reference = ampdu, .is_last = frame.is_last_of_ampdu};
    // Only a single MPDU is marked with EOF.
    if (mode.modulation != sim::radio::ModulationClass::kHt) place->is_eof = false;
  }
  return put_radiotap_phy(header,
                          {.phy = phy_of(mode.modulation),
                           .mcs = mode.mcs,
                           .streams = mode.streams,
                           .width_mhz = mode.width,
                           .guard_ns = static_cast<int>(mode.guard.count()),
                           .he_ltf_ns = he_ltf_of(mode)},
                          place);
}

}  // namespace

hal::Bytes with_radiotap(const sim::radio::Frame& frame, const RadiotapFields& fields) {
  const auto rate = rate_of(frame);
  std::uint32_t present = 1U << kTsft | 1U << kFlags | 1U << kChannel;
  if (rate) present |= 1U << kRate;
  if (fields.signal_dbm) present |= 1U << kSignal;
  if (fields.noise_dbm) present |= 1U << kNoise;

  hal::Bytes out{0, 0, 0, 0, 0, 0, 0, 0};  // version, padding, length; it_present
  put_field(
      out,
      std::chrono::floor<std::chrono::microseconds>(fields.mpdu_start.time_since_epoch()).count());
  out.push_back(flags_of(frame));
  if (rate) out.push_back(*rate);
  if (out.size() % 2 != 0) out.push_back(0);
  put_field(out, fields.frequency);
  put_field(out, channel_flags(frame, fields.frequency));
  if (fields.signal_dbm) out.push_back(whole_dbm(*fields.signal_dbm));
  if (fields.noise_dbm) out.push_back(whole_dbm(*fields.noise_dbm));
  present |= put_mode(out, frame, fields.ampdu);
  out[2] = static_cast<std::uint8_t>(out.size());
  for (std::size_t i = 0; i < 4; ++i) {
    out[4 + i] = static_cast<std::uint8_t>(present >> (8 * i));
  }

  const hal::Bytes mpdu = sim::radio::encode(frame);
  out.insert(out.end(), mpdu.begin(), mpdu.end());
  return out;
}

}  // namespace results::record
