#pragma once

#include <cstdint>
#include <vector>

#include "hal/types/quantity.h"
#include "sim/radio/radio_config.h"

namespace results::coverage {

/// The rates of a transmitter's data frames by received power, without interference: the highest at
/// which no more than kUsableLoss of the frames are lost, by the error models of its modes.
class UsableRate {
 public:
  /// @param radio  of the transmitter (config_for). @param bytes  length of the PSDU, > 0.
  UsableRate(const sim::radio::RadioConfig& radio, std::uint32_t bytes);

  /// 0: none.
  hal::BitsPerSecond at(hal::Dbm power) const;

  struct Step {
    hal::Dbm needed{};
    hal::BitsPerSecond rate{};
  };
  /// All modes, in descending order of rates.
  const std::vector<Step>& steps() const { return steps_; }

 private:
  std::vector<Step> steps_;
};

}  // namespace results::coverage
