#pragma once

#include "sim/radio/channel/path_loss.h"

namespace sim::radio {

/// Free space (Friis): the power law with exponent 2.
struct FriisConfig {
  static constexpr std::string_view kModel = "friis";
  static constexpr PathLossKind kKind = PathLossKind::kLawOfDistance;
};

template <class Fields>
void keys_of(Fields& /*io*/, FriisConfig& /*config*/) {}

std::unique_ptr<const PathLoss> make(const FriisConfig& config, const PropagationConfig& air,
                                     const Ground& ground);

}  // namespace sim::radio
