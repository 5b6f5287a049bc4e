#include "sim/radio/airtime.h"

namespace sim::radio {
namespace {

constexpr std::uint32_t kRtsBits = 160;
constexpr std::uint32_t kCtsOrAckBits = 112;
constexpr std::uint32_t kDataOverheadBytes = 24 + 8 + 4;  // MAC header, LLC/SNAP, FCS
constexpr std::int64_t kNsPerSecond = 1'000'000'000;

/// bits / rate, rounded up or to the nearest multiple of 1 s / per_second.
std::int64_t ticks(std::uint32_t bits, hal::BitsPerSecond rate, std::int64_t per_second, bool up) {
  const auto bits_per_second = static_cast<std::int64_t>(rate.value);
  const std::int64_t numerator = static_cast<std::int64_t>(bits) * per_second;
  return (numerator + (up ? bits_per_second - 1 : bits_per_second / 2)) / bits_per_second;
}

}  // namespace

std::uint32_t Airtime::mpdu_bits(FrameType type, std::size_t payload) const {
  if (type == FrameType::kRts) return kRtsBits;
  if (type != FrameType::kData) return kCtsOrAckBits;
  if (config_.lengths == Lengths::kFixed) {
    return config_.fixed_header_bits + config_.fixed_payload_bits;
  }
  return 8 * (static_cast<std::uint32_t>(payload) + kDataOverheadBytes);
}

bool Airtime::short_preamble(hal::BitsPerSecond rate) const {
  return config_.preamble == Preamble::kShort && rate.value > 1e6;
}

hal::Duration Airtime::plcp(hal::BitsPerSecond rate) const {
  if (config_.profile == Profile::kDisk || config_.profile == Profile::kIdeal) return {};
  return short_preamble(rate) ? 96us : 192us;
}

hal::Duration Airtime::preamble(hal::BitsPerSecond rate) const {
  return short_preamble(rate) ? 72us : 144us;
}

hal::Duration Airtime::of(std::uint32_t mpdu_bits, hal::BitsPerSecond rate) const {
  if (config_.profile == Profile::kIdeal) return {};
  if (config_.rounding == Rounding::kMicrosecond) {
    return plcp(rate) + std::chrono::microseconds{ticks(mpdu_bits, rate, 1'000'000, true)};
  }
  return plcp(rate) + hal::Duration{ticks(mpdu_bits, rate, kNsPerSecond, false)};
}

}  // namespace sim::radio
