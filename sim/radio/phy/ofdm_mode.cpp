#include "sim/radio/phy/ofdm_mode.h"

#include <algorithm>
#include <array>

#include "hal/types/check.h"
#include "sim/radio/phy/ofdm_error_model.h"

namespace sim::radio {
namespace {

using namespace std::chrono_literals;

constexpr hal::Duration kSymbol = 4us;
constexpr hal::Duration kSignalExtension = 6us;
constexpr std::int64_t kServiceAndTailBits = 16 + 6;
constexpr Coding kSignalCoding{Constellation::kBpsk, CodeRate::kHalf};
constexpr double kSignalBits = 24;

/// IEEE Std 802.11-2016, table 17-4, in the order of kOfdmRates.
constexpr std::array kCodings{Coding{Constellation::kBpsk, CodeRate::kHalf},
                              Coding{Constellation::kBpsk, CodeRate::kThreeQuarters},
                              Coding{Constellation::kQpsk, CodeRate::kHalf},
                              Coding{Constellation::kQpsk, CodeRate::kThreeQuarters},
                              Coding{Constellation::kQam16, CodeRate::kHalf},
                              Coding{Constellation::kQam16, CodeRate::kThreeQuarters},
                              Coding{Constellation::kQam64, CodeRate::kTwoThirds},
                              Coding{Constellation::kQam64, CodeRate::kThreeQuarters}};
static_assert(kCodings.size() == kOfdmRates.size());

std::uint8_t number_of(hal::BitsPerSecond rate) {
  const auto* const found = std::ranges::find(kOfdmRates, rate.value);
  BARAKA_CHECK(found != kOfdmRates.end());
  return static_cast<std::uint8_t>(found - kOfdmRates.begin());
}

}  // namespace

Coding ofdm_coding(hal::BitsPerSecond rate) { return kCodings[number_of(rate)]; }

OfdmMode::OfdmMode(hal::BitsPerSecond rate, const Options& options)
    : PhyMode({.modulation = ModulationClass::kOfdm, .mcs = number_of(rate), .guard = 800ns}, rate,
              16us, 4us),
      options_(options),
      coding_(ofdm_coding(rate)) {}

bool OfdmMode::is_mandatory() const {
  return rate().value == 6e6 || rate().value == 12e6 || rate().value == 24e6;
}

hal::Duration OfdmMode::airtime(std::uint32_t mpdu_bits) const {
  const auto bits_per_symbol = static_cast<std::int64_t>(rate().value * hal::to_seconds(kSymbol));
  const std::int64_t bits = kServiceAndTailBits + static_cast<std::int64_t>(mpdu_bits);
  const std::int64_t symbols = (bits + bits_per_symbol - 1) / bits_per_symbol;
  return preamble_and_header() + symbols * kSymbol + extension();
}

hal::Duration OfdmMode::extension() const {
  return options_.is_erp ? kSignalExtension : hal::Duration{};
}

hal::Duration OfdmMode::signal_extension() const {
  return options_.at_risk == BitsAtRisk::kMpdu ? extension() : hal::Duration{};
}

double OfdmMode::bits_at_risk(std::uint32_t mpdu_bits) const {
  if (options_.at_risk == BitsAtRisk::kMpdu) return mpdu_bits;
  return rate().value * hal::to_seconds(airtime(mpdu_bits) - preamble_and_header());
}

double OfdmMode::header_success(double sinr, double share) const {
  return ofdm_success_probability(sinr, kSignalCoding, share * kSignalBits);
}

double OfdmMode::success(double sinr, double bits) const {
  return options_.curve ? options_.curve->success(sinr, bits)
                        : ofdm_success_probability(sinr, coding_, bits);
}

}  // namespace sim::radio
