#pragma once

#include <string>
#include <vector>

#include "sim/radio/radio_config.h"

namespace sim::radio {

/// A value of a radio that its form or another value excludes.
struct BrokenRule {
  std::string key;   ///< As files name it, dotted: "bss.ssid".
  std::string what;  ///< "must not be empty"
};

/// What a radio's configuration must be, beyond the ranges of its single values in files: every
/// rule that it breaks.
std::vector<BrokenRule> broken_rules(const RadioConfig& config);

/// The same of what a station has of its own in such a network.
std::vector<BrokenRule> broken_rules(const RadioConfig& config, const StationConfig& station);

/// "nakagami, rician and rayleigh": the models of a kind that files can name.
std::string models_of(PathLossKind kind);

/// @throws std::invalid_argument  the first rule that is broken.
void check(const RadioConfig& config);
/// The same of what a station has of its own in such a network.
void check(const RadioConfig& config, const StationConfig& station);

}  // namespace sim::radio
