#include "results/coverage/usable_rate.h"

#include <algorithm>

#include "hal/types/math.h"
#include "results/coverage/coverage.h"
#include "sim/radio/channel/propagation.h"
#include "sim/radio/station_profile.h"

namespace results::coverage {
namespace {

using sim::radio::PhyMode;
using sim::radio::RadioConfig;
using sim::radio::WavesConfig;

constexpr double kLowestSnr = -20, kHighestSnr = 80;  // dB
constexpr int kHalvings = 40;
constexpr double kNoiseWidth = 20;  // MHz, of the noise floor

double ratio(double decibels) { return hal::math::pow(10, decibels / 10); }

bool is_usable(const PhyMode& mode, double snr, std::uint32_t bytes) {
  const double sinr = ratio(snr);
  const double arrives =
      mode.header_success(sinr, 1) * mode.success(sinr, mode.bits_at_risk(8 * bytes));
  return arrives >= 1 - kUsableLoss;
}

/// Least SNR in the mode's width, dB, by bisection: success grows with it.
double needed_snr(const PhyMode& mode, std::uint32_t bytes) {
  double low = kLowestSnr, high = kHighestSnr;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    (is_usable(mode, middle, bytes) ? high : low) = middle;
  }
  return high;
}

hal::Dbm needed_power(const PhyMode& mode, const WavesConfig& waves, std::uint32_t bytes) {
  const double snr = std::max(needed_snr(mode, bytes), waves.receiver.min_sinr.value);
  const double wider = 10 * hal::math::log10(mode.width() / kNoiseWidth);
  const double needed = waves.receiver.noise_floor.value + wider + snr;
  return hal::Dbm{std::max(needed, waves.receiver.sensitivity.value)};
}

/// Whether the transmitter uses the mode for data; with rate control, its data mode is the highest.
bool is_data_mode(const PhyMode& mode, const PhyMode& data) {
  if (sim::radio::has_streams(mode.modulation_class())) return true;
  return mode.rate() <= data.reference_rate();
}

}  // namespace

UsableRate::UsableRate(const RadioConfig& radio, std::uint32_t bytes) {
  const sim::radio::ModeSet modes(radio);
  const WavesConfig& waves = *waves_of(radio);
  for (const auto& mode : modes.all()) {
    if (!is_data_mode(*mode, modes.data())) continue;
    steps_.push_back({needed_power(*mode, waves, bytes), mode->rate()});
  }
  std::ranges::stable_sort(steps_, std::ranges::greater{}, &Step::rate);
}

hal::BitsPerSecond UsableRate::at(hal::Dbm power) const {
  const auto found =
      std::ranges::find_if(steps_, [power](const Step& step) { return power >= step.needed; });
  return found == steps_.end() ? hal::BitsPerSecond{} : found->rate;
}

}  // namespace results::coverage
