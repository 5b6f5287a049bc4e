#include "sim/radio/phy/dsss_mode.h"

#include <algorithm>

#include "sim/radio/phy/error_model.h"

namespace sim::radio {
namespace {

constexpr double kHeaderBits = 48;
constexpr std::int64_t kNsPerSecond = 1'000'000'000;

/// Bits / rate, rounded up or to the nearest multiple of 1 s / per_second, in such units.
std::int64_t ticks(std::uint32_t bits, hal::BitsPerSecond rate, std::int64_t per_second, bool up) {
  const auto bits_per_second = static_cast<std::int64_t>(rate.value);
  const std::int64_t numerator = static_cast<std::int64_t>(bits) * per_second;
  return (numerator + (up ? bits_per_second - 1 : bits_per_second / 2)) / bits_per_second;
}

hal::Duration exact(std::uint32_t bits, hal::BitsPerSecond rate) {
  return hal::Duration{ticks(bits, rate, kNsPerSecond, false)};
}

bool is_short(hal::BitsPerSecond rate, Preamble preamble) {
  return preamble == Preamble::kShort && rate > hal::BitsPerSecond{1e6};
}

std::uint8_t place_of(hal::BitsPerSecond rate) {
  return static_cast<std::uint8_t>(std::ranges::find(kDsssRates, rate.value) - kDsssRates.begin());
}

}  // namespace

DsssMode::DsssMode(hal::BitsPerSecond rate, const Options& options)
    : PhyMode({.modulation = ModulationClass::kDsss, .mcs = place_of(rate)}, rate,
              is_short(rate, options.preamble) ? 72us : 144us,
              is_short(rate, options.preamble) ? 24us : 48us),
      header_rate_(is_short(rate, options.preamble) ? 2e6 : 1e6),
      rounding_(options.rounding),
      errors_(options.errors) {
  // Computes the table for CCK now: it takes 6 ms of processor time, which would delay frames of
  // programs if it were computed at the first reception.
  (void)success_probability(errors_, 1, rate, 1);
}

hal::Duration DsssMode::airtime(std::uint32_t mpdu_bits) const {
  if (rounding_ == Rounding::kMicrosecond) {
    return preamble_and_header() +
           std::chrono::microseconds{ticks(mpdu_bits, rate(), 1'000'000, true)};
  }
  return preamble_and_header() + exact(mpdu_bits, rate());
}

double DsssMode::header_success(double sinr, double share) const {
  return success_probability(errors_, sinr, header_rate_, share * kHeaderBits);
}

double DsssMode::success(double sinr, double bits) const {
  return success_probability(errors_, sinr, rate(), bits);
}

PlainMode::PlainMode(hal::BitsPerSecond rate, bool is_instant)
    : PhyMode({}, rate, {}, {}), is_instant_(is_instant) {}

hal::Duration PlainMode::airtime(std::uint32_t mpdu_bits) const {
  return is_instant_ ? hal::Duration{} : exact(mpdu_bits, rate());
}

}  // namespace sim::radio
