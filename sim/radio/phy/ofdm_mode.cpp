#include "sim/radio/phy/ofdm_mode.h"

#include "sim/radio/phy/ofdm_error_model.h"

namespace sim::radio {
namespace {

using namespace std::chrono_literals;

constexpr hal::Duration kSymbol = 4us;
constexpr hal::Duration kSignalExtension = 6us;
constexpr std::int64_t kServiceAndTailBits = 16 + 6;
constexpr hal::BitsPerSecond kSignalRate{6e6};
constexpr double kSignalBits = 24;

}  // namespace

OfdmMode::OfdmMode(hal::BitsPerSecond rate, BitsAtRisk at_risk)
    : PhyMode(rate, 16us, 4us), at_risk_(at_risk) {}

bool OfdmMode::is_mandatory() const {
  return rate().value == 6e6 || rate().value == 12e6 || rate().value == 24e6;
}

hal::Duration OfdmMode::airtime(std::uint32_t mpdu_bits) const {
  const auto bits_per_symbol = static_cast<std::int64_t>(rate().value * hal::to_seconds(kSymbol));
  const std::int64_t bits = kServiceAndTailBits + static_cast<std::int64_t>(mpdu_bits);
  const std::int64_t symbols = (bits + bits_per_symbol - 1) / bits_per_symbol;
  return preamble_and_header() + symbols * kSymbol + kSignalExtension;
}

hal::Duration OfdmMode::signal_extension() const {
  return at_risk_ == BitsAtRisk::kMpdu ? kSignalExtension : hal::Duration{};
}

double OfdmMode::bits_at_risk(std::uint32_t mpdu_bits) const {
  if (at_risk_ == BitsAtRisk::kMpdu) return mpdu_bits;
  return rate().value * hal::to_seconds(airtime(mpdu_bits) - preamble_and_header());
}

double OfdmMode::header_success(double sinr, double share) const {
  return ofdm_success_probability(sinr, kSignalRate, share * kSignalBits);
}

double OfdmMode::success(double sinr, double bits) const {
  return ofdm_success_probability(sinr, rate(), bits);
}

}  // namespace sim::radio
