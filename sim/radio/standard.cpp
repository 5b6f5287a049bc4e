#include "sim/radio/standard.h"

#include <algorithm>

namespace sim::radio {

ModulationClass newest_class(Standard standard) {
  switch (standard) {
    case Standard::kIeee80211b:
      return ModulationClass::kDsss;
    case Standard::kIeee80211g:
      return ModulationClass::kOfdm;
    case Standard::kIeee80211n:
      return ModulationClass::kHt;
    case Standard::kIeee80211ac:
      return ModulationClass::kVht;
    case Standard::kIeee80211ax:
      return ModulationClass::kHe;
  }
  return ModulationClass::kNone;
}

std::string_view rates_of(Standard standard) {
  switch (standard) {
    case Standard::kIeee80211b:
      return "1, 2, 5.5 or 11 Mb/s";
    case Standard::kIeee80211g:
    case Standard::kIeee80211n:
    case Standard::kIeee80211ax:
      return "1, 2, 5.5, 11, 6, 9, 12, 18, 24, 36, 48 or 54 Mb/s";
    case Standard::kIeee80211ac:
      return "6, 9, 12, 18, 24, 36, 48 or 54 Mb/s";
  }
  return {};
}

bool is_dsss_rate(hal::BitsPerSecond rate) {
  return std::ranges::find(kDsssRates, rate.value) != kDsssRates.end();
}

bool is_rate(Standard standard, hal::BitsPerSecond rate) {
  if (is_dsss_rate(rate)) return standard != Standard::kIeee80211ac;
  const bool is_ofdm = std::ranges::find(kOfdmRates, rate.value) != kOfdmRates.end();
  return is_ofdm && standard != Standard::kIeee80211b;
}

}  // namespace sim::radio
