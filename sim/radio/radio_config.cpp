#include "sim/radio/radio_config.h"

namespace sim::radio {
namespace {

/// Range of mobility_framework: 0.125 m / (4 pi) * sqrt(2 mW / -85 dBm), rounded up.
constexpr hal::Metres kMobilityFrameworkRange{250.16};

RadioConfig ieee80211b() {
  RadioConfig config;
  config.tx_power = hal::Milliwatts{40};
  config.wavelength = hal::Metres{299792458.0 / 2.412e9};  // channel 1
  config.propagation_delay = true;
  config.sensitivity = hal::Dbm{-82};
  config.interference_floor = hal::Dbm{-101};
  config.noise_floor = hal::Dbm{-93.97};  // 20 MHz at 290 K, noise figure 7 dB
  config.cca_threshold = hal::Dbm{-82};
  config.energy_detection = hal::Dbm{-62};
  config.control_rate = hal::BitsPerSecond{1e6};
  config.broadcast_rate = hal::BitsPerSecond{1e6};
  config.rounding = Rounding::kMicrosecond;
  config.lengths = Lengths::kBytes;
  config.error_model = ErrorModel::kDsss;
  config.preamble_window = 4us;
  config.cw_min = 31;
  config.cw_max = 1023;
  config.rts_threshold = 2347;  // IEEE Std 802.11-2016, dot11RTSThreshold: never
  config.queue_limit = 500;
  return config;
}

RadioConfig without_mac(Profile profile) {
  RadioConfig config;
  config.profile = profile;
  config.lengths = Lengths::kBytes;
  config.range = kMobilityFrameworkRange;
  return config;
}

}  // namespace

RadioConfig profile_defaults(Profile profile) {
  RadioConfig config = profile == Profile::kIeee80211b ? ieee80211b() : RadioConfig{};
  if (profile == Profile::kDisk || profile == Profile::kIdeal) config = without_mac(profile);
  config.profile = profile;
  return config;
}

bool has_mac(const RadioConfig& config) {
  return config.profile == Profile::kMobilityFramework || config.profile == Profile::kIeee80211b;
}

}  // namespace sim::radio
